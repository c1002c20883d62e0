"""Several processes: two simulators at once, and one faster than real time.

The launch file that comes along, with draw_square and mimic, as separate processes.
"""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import pytest
from tests.places import EXAMPLES, ROS2

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from turtlesim.draw_square import SquarePlan, _left_of
from turtlesim.model import TICK_NS, World
from turtlesim.msg import Pose
from turtlesim.srv import Spawn
from turtlewire import msg, wire
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


def test_two_fields_one_mimics_the_other(run):
    """multisim.launch.py, draw_square in one namespace, and mimic between the two."""
    quiet = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
    launch = run(ROS2, "launch", "turtlesim", "multisim.launch.py", environment=quiet)
    launch.wait_for(r"Starting turtlesim with node name /turtlesim1/turtlesim")
    launch.wait_for(r"Starting turtlesim with node name /turtlesim2/turtlesim")
    rules = "-r input/pose:=/turtlesim1/turtle1/pose -r output/cmd_vel:=/turtlesim2/turtle1/cmd_vel"
    run(ROS2, "run", "turtlesim", "mimic", "--ros-args", *rules.split())
    context, moved = wire.open_context(), threading.Event()
    try:
        pose = msg.get_message("turtlesim/msg/Pose")
        type_id = TypeId("turtlesim/msg/Pose", msg.type_hash("turtlesim/msg/Pose"))

        def look(cdr, _):
            if msg.deserialize(pose, cdr).x > 6.5:
                moved.set()

        context.create_node("eye").create_subscription(
            "/turtlesim2/turtle1/pose", type_id, QoS(), look
        )
        square = run(
            ROS2, "run", "turtlesim", "draw_square", "--ros-args", "-r", "__ns:=/turtlesim1"
        )
        square.wait_for("New goal")
        # On a busy machine draw_square may miss its goal, as ROS 2's does: the goal is 0.2 m wide.
        assert moved.wait(120)
    finally:
        context.close()
    launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0
    assert launch.survivors() == []
    assert launch.text.count("process has finished cleanly") == 2


# The square: its plan on the model without ROS, tick by tick, and its words.


def test_four_sides_and_four_turns_come_back_to_the_start():
    log: list[str] = []
    plan = SquarePlan(log.append)
    world = World()
    turtle = world.spawn_centred()
    corners = []
    for tick in range(6000):
        (result,) = world.step(tick * TICK_NS)
        said = len(log)
        forward, turning = plan.command(result.pose)
        turtle.drive(forward, 0.0, turning)
        if "Reached goal" in log[said:]:
            corners.append((result.pose.x, result.pose.y))
        if len(corners) == 8:
            break
    assert len(corners) == 8
    middle = 5.544445
    for (x, y), (right, up) in zip(corners[::2], [(2, 0), (2, 2), (0, 2), (0, 0)], strict=True):
        assert (x, y) == (
            pytest.approx(middle + right, abs=0.25),
            pytest.approx(middle + up, abs=0.25),
        )
    assert turtle.theta == pytest.approx(0.0, abs=0.05)
    assert log[0] == "New goal [7.544445 5.544445, 0.000000]"
    assert [line.split(" [")[0] for line in log] == [
        "New goal",
        *(8 * ["Reached goal", "New goal"]),
    ]


def test_a_turn_to_the_left_ends_between_minus_pi_and_pi():
    headings = (0.0, math.pi / 2, 0.75 * math.pi, math.pi)
    turned = [_left_of(SimpleNamespace(x=1.0, y=2.0, theta=theta)).theta for theta in headings]
    assert turned == pytest.approx([math.pi / 2, math.pi, -0.75 * math.pi, -math.pi / 2])


# Faster than real time: the chase over DDS, in the simulator's time.

EXERCISE = EXAMPLES / "graded_exercise"
NODE = (
    "import rclpy, sys; from {module} import {name}; rclpy.init(args=sys.argv); "
    "rclpy.spin({name}())"
)
SPEED = 5.0


def start(code: list[str], *parameters: str) -> subprocess.Popen:
    arguments = [part for parameter in parameters for part in ("-p", parameter)]
    return subprocess.Popen(
        [sys.executable, *code, "--ros-args", *arguments],
        cwd=EXERCISE,
        stderr=subprocess.PIPE,
        env=os.environ,
    )


@pytest.fixture
def chase():
    """A simulator at five times real time, two broadcasters and a follower: four processes."""
    broadcaster = ["-c", NODE.format(module="broadcaster", name="Broadcaster")]
    processes = [
        start(["-m", "turtlesim.turtlesim_node", "--headless", "--speed", str(SPEED)]),
        start(broadcaster, "turtlename:=turtle1", "use_sim_time:=true"),
        start(broadcaster, "turtlename:=turtle2", "use_sim_time:=true"),
        start(["-c", NODE.format(module="follower", name="Follower")], "use_sim_time:=true"),
    ]
    yield processes
    for process in processes:
        process.send_signal(signal.SIGINT)
    for process in processes:
        process.communicate(timeout=300)


def test_the_chase_ends_where_it_does_in_lock_step(chase):
    rclpy.init(args=[])
    node = Node("judge")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    poses: dict[str, Pose] = {}
    clock: list[float] = []
    node.create_subscription(
        Clock,
        "/clock",
        lambda message: clock.append(message.clock.sec + message.clock.nanosec / 1e9),
        1,
    )
    for name in ("turtle1", "turtle2"):
        node.create_subscription(
            Pose, f"/{name}/pose", lambda pose, name=name: poses.__setitem__(name, pose), 1
        )
    spawner = node.create_client(Spawn, "/spawn")
    assert spawner.wait_for_service(timeout_sec=60)
    spawner.call_async(Spawn.Request(x=4.0, y=2.0, theta=0.0, name="turtle2"))

    def spin_until(is_done) -> None:
        deadline = time.monotonic() + 90
        while not is_done():
            assert time.monotonic() < deadline
            executor.spin_once(timeout_sec=0.1)

    spin_until(lambda: "turtle2" in poses and poses["turtle2"].linear_velocity > 0.0 and clock)
    start_clock = clock[-1]
    spin_until(lambda: clock[-1] >= start_clock + 12.0)
    away = (
        (poses["turtle1"].x - poses["turtle2"].x) ** 2
        + (poses["turtle1"].y - poses["turtle2"].y) ** 2
    ) ** 0.5
    assert away < 0.1  # lock-step ends at 0.01 m; 0.1 m is the tolerance for processes
    node.destroy_node()
    executor.shutdown()
    rclpy.try_shutdown()
