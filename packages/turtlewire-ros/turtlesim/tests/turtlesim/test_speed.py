"""Faster than real time in separate processes: the chase over DDS, in the simulator's time."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import pytest
from tests.places import EXAMPLES

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from turtlesim.msg import Pose
from turtlesim.srv import Spawn

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
