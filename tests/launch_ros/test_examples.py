"""The launch files in examples/, and a launched teleop, with the real nodes."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

ROS2 = Path(sys.executable).parent / "ros2"
EXAMPLES = Path(__file__).parents[2] / "examples"
HEADLESS = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}


def test_the_demo_in_one_process(run):
    launch = run(ROS2, "launch", EXAMPLES / "one_process.launch.py", environment=HEADLESS)
    for name in ("sim", "broadcaster1", "broadcaster2", "listener"):
        launch.wait_for(rf"Loaded node '/{name}' in container '/demo'")
    launch.wait_for(r"\[sim\]: Spawning turtle \[turtle2\]")
    os.kill(launch.process.pid, signal.SIGINT)
    assert launch.wait() == 0
    assert launch.text.count("process started with pid") == launch.text.count("process has finished cleanly") == 1
    assert "Traceback" not in launch.text
    assert launch.survivors() == []


TELEOP = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(package="turtlesim", executable="turtlesim_node"),
        Node(package="turtlesim", executable="turtle_teleop_key", output="screen", emulate_tty=True),
    ])
"""


def test_a_launched_teleop_reads_the_terminal(ros2_launch):
    launch = ros2_launch(TELEOP, environment=HEADLESS, terminal=True)
    launch.wait_for(r"\[turtle_teleop_key-2\] Use arrow keys to move the turtle\.")
    launch.wait_for(r"Spawning turtle \[turtle1\]")
    launch.wait_for(r"'Q' to quit\.")
    launch.type("q")
    launch.wait_for(r"\[turtle_teleop_key-2\]: process has finished cleanly")
    launch.type("\x03")
    assert launch.wait() == 0
    assert "Traceback" not in launch.text
