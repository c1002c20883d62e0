"""`ros2 run robot_state_publisher robot_state_publisher`, seen from outside."""

from __future__ import annotations

import signal
import sys
from pathlib import Path

URDF = """<robot name="r">
  <link name="base"/><link name="arm"/><link name="tool"/>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="arm"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="tip" type="fixed">
    <parent link="arm"/><child link="tool"/><origin xyz="0 0 2"/>
  </joint>
</robot>"""
ROS2 = Path(sys.executable).parent / "ros2"
STATE = "{header: {stamp: {sec: 10}}, name: [turn], position: [0.0]}"


def test_from_joint_state_to_transform(run, tmp_path):
    (tmp_path / "robot.urdf").write_text(URDF)
    package = "robot_state_publisher"
    publisher = run(
        *(ROS2, "run", package, package, "robot.urdf", "--ros-args", "-p", "frame_prefix:=r1_"),
        *("-p", "ignore_timestamp:=true"),
        cwd=tmp_path,
    )
    publisher.wait_for("Robot initialized")
    run(ROS2, "topic", "pub", "--rate", "20", "/joint_states", "sensor_msgs/msg/JointState", STATE)
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "r1_base", "r1_tool")
    echo.wait_for(r"Translation: \[1\.000, 0\.000, 2\.000\]")
    description = run(ROS2, "topic", "echo", "--once", "--full-length", "/robot_description")
    description.wait_for("robot name")
    publisher.signal_group(signal.SIGINT)
    assert publisher.wait() == 0
    assert publisher.survivors() == []
    assert "Traceback" not in publisher.text


def test_help(run):
    program = run(ROS2, "run", "robot_state_publisher", "robot_state_publisher", "--help")
    assert program.wait() == 0
    assert "ignore_timestamp" in program.text
