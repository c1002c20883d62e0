"""A full disk costs the log files and what was to be written, never the program."""

import sys

import pytest
from tests.places import ROS2

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="there a file's size cannot be limited"),
]

#: Runs the arguments while no file can grow beyond so many bytes.
LIMITED = "import os, sys; os.execvp(sys.argv[1], sys.argv[1:])"
LOGGING = """
import rclpy
rclpy.init()
node = rclpy.create_node("talkative")
for number in range(50):
    node.get_logger().info(f"line {number} " + "x" * 100)
rclpy.shutdown()
"""
LAUNCH = """
from launch import LaunchDescription
from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown

def generate_launch_description():
    talk = ExecuteProcess(cmd=["echo", "said by a child"], output="both")
    return LaunchDescription([
        *[LogInfo(msg=f"line {number} " + "x" * 100) for number in range(20)],
        talk,
        RegisterEventHandler(
            OnProcessExit(target_action=talk, on_exit=[EmitEvent(event=Shutdown())])
        ),
    ])
"""


@pytest.mark.parametrize("size", [0, 1000])
def test_a_full_disk_does_not_stop_logging_and_is_reported_once(size, python, ends_well):
    program = python(LOGGING, limits={"RLIMIT_FSIZE": size})
    assert ends_well(program) == 0, program.text
    assert program.text.count("line ") == 50
    assert program.text.count("the disk may be full") == 1


@pytest.mark.parametrize("size", [0, 1000])
def test_a_launch_goes_on_and_says_once_for_each_file_that_it_lacks_lines(
    size, python, ends_well, tmp_path
):
    (tmp_path / "talk.launch.py").write_text(LAUNCH)
    program = python(
        LIMITED, ROS2, "launch", "./talk.launch.py", cwd=tmp_path, limits={"RLIMIT_FSIZE": size}
    )
    assert ends_well(program) == 0, program.text
    assert "Traceback" not in program.text
    assert program.text.count("line ") == 20
    assert "said by a child" in program.text
    assert program.text.count("launch.log: File too large") == 1


@pytest.mark.parametrize(
    "words",
    [
        ["ros2", "pkg", "create", "full"],
        ["ros2", "run", "tf2_tools", "view_frames", "--wait-time", "0.1"],
    ],
)
def test_a_command_that_writes_says_that_it_could_not(words, python, ends_well, tmp_path):
    command = [ROS2.parent / words[0], *words[1:]]
    program = python(LIMITED, *command, cwd=tmp_path, limits={"RLIMIT_FSIZE": 10})
    assert ends_well(program) == 1, program.text
    assert "File too large" in program.text
    assert "Traceback" not in program.text
