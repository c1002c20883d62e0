"""Starts a talker and a listener."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return the two nodes."""
    return LaunchDescription(
        [
            Node(package="demo_nodes_cpp", executable=name, output="screen")
            for name in ("talker", "listener")
        ]
    )
