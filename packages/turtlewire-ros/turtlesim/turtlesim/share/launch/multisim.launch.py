"""Two simulators, each in its own namespace."""  # noqa: INP001 -- data, not a module

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Give the description to `ros2 launch turtlesim multisim.launch.py`."""
    return LaunchDescription(
        [
            Node(
                package="turtlesim",
                executable="turtlesim_node",
                namespace=namespace,
                output="screen",
            )
            for namespace in ("turtlesim1", "turtlesim2")
        ]
    )
