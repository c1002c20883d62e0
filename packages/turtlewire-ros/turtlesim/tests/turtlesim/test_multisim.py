"""Two simulators at once.

The launch file that comes along, with draw_square and mimic, as separate processes.
"""

from __future__ import annotations

import math
import signal
import threading
from types import SimpleNamespace

import pytest
from tests.places import ROS2

from turtlesim.draw_square import SquarePlan, _left_of
from turtlesim.model import TICK_NS, World
from turtlewire import msg, wire
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


def test_two_fields_one_mimics_the_other(run):
    """multisim.launch.py, draw_square in one namespace, and mimic between the two."""
    quiet = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
    launch = run(ROS2, "launch", "turtlesim", "multisim.launch.py", environment=quiet)
    launch.wait_for(r"Starting turtlesim with node name /turtlesim1/turtlesim")
    launch.wait_for(r"Starting turtlesim with node name /turtlesim2/turtlesim")
    remaps = [
        "-r",
        "input/pose:=/turtlesim1/turtle1/pose",
        "-r",
        "output/cmd_vel:=/turtlesim2/turtle1/cmd_vel",
    ]
    run(ROS2, "run", "turtlesim", "mimic", "--ros-args", *remaps)
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
