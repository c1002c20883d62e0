"""Starts the service that adds two integers, and its client."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return the two nodes."""
    return LaunchDescription(
        [
            Node(package="demo_nodes_cpp", executable=f"add_two_ints_{role}", output="screen")
            for role in ("server", "client")
        ]
    )
