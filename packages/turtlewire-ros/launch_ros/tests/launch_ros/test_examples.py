"""The launch files in examples/, and a launched teleop, with the real nodes."""

import os
import re
import signal

import pytest
from tests.places import EXAMPLES, ROS2

HEADLESS = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}


def test_the_demo_in_one_process(run):
    launch = run(ROS2, "launch", EXAMPLES / "one_process.launch.py", environment=HEADLESS)
    for name in ("sim", "broadcaster1", "broadcaster2", "listener"):
        launch.wait_for(rf"Loaded node '/{name}' in container '/demo'")
    launch.wait_for(r"\[sim\]: Spawning turtle \[turtle2\]")
    os.kill(launch.process.pid, signal.SIGINT)
    assert launch.wait() == 0
    assert (
        launch.text.count("process started with pid")
        == launch.text.count("process has finished cleanly")
        == 1
    )
    assert "Traceback" not in launch.text
    assert launch.survivors() == []


TELEOP = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(package="turtlesim", executable="turtlesim_node"),
        Node(package="turtlesim", executable="turtle_teleop_key", output="screen"OPTIONS),
    ])
"""


@pytest.mark.parametrize("options", ["", ", emulate_tty=True"])
def test_a_launched_teleop_reads_the_terminal(ros2_launch, options):
    launch = ros2_launch(TELEOP.replace("OPTIONS", options), environment=HEADLESS, terminal=True)
    launch.wait_for(r"\[turtle_teleop_key-2\] Use arrow keys to move the turtle\.")
    launch.wait_for(r"Spawning turtle \[turtle1\]")
    launch.wait_for(r"'Q' to quit\.")
    launch.type("q")
    launch.wait_for(r"\[turtle_teleop_key-2\]: process has finished cleanly")
    launch.type("\x03")
    assert launch.wait() == 0
    assert "Traceback" not in launch.text


def test_the_terminal_is_as_before_after_a_launched_teleop(run, tmp_path):
    (tmp_path / "test.launch.py").write_text(TELEOP.replace("OPTIONS", ""))
    commands = f"trap : INT; stty -g; {ROS2} launch ./test.launch.py; echo status $?; stty -g"
    shell = run("sh", "-c", commands, environment=HEADLESS, cwd=tmp_path, terminal=True)
    shell.wait_for(r"Spawning turtle \[turtle1\]")
    shell.wait_for(r"'Q' to quit\.")
    shell.type("\x03")
    shell.wait_for("status 0")
    assert shell.wait() == 0
    before, after = re.findall(r"(?m)^[0-9a-f]+(?::[0-9a-f]+)+$", shell.text)
    assert before == after
    assert "Traceback" not in shell.text
    assert shell.survivors() == []
