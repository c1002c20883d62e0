"""The walker, walking in a circle: ``ros2 launch walker.launch.py``."""

from __future__ import annotations

import sys

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import Command, PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    """Return the robot's program, and the robot_state_publisher with the robot's description."""
    here = ThisLaunchFileDir()
    xacro = Command(['xacro "', PathJoinSubstitution([here, "walker.urdf.xacro"]), '"'])
    return LaunchDescription(
        [
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[
                    {
                        "robot_description": ParameterValue(xacro, value_type=str),
                        "publish_frequency": 100.0,  # the program sends 25 states a second
                    }
                ],
            ),
            ExecuteProcess(
                cmd=[sys.executable, PathJoinSubstitution([here, "walker.py"])],
                output="screen",
            ),
        ]
    )
