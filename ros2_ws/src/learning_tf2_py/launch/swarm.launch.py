"""A field full of turtles, each of which follows the one before it: `ros2 launch learning_tf2_py swarm.launch.py count:=1000`."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "count", default_value="1000", description="How many turtles there are."
            ),
            Node(
                package="learning_tf2_py",
                executable="swarm_with_simulator",
                parameters=[{"count": LaunchConfiguration("count")}],
                output="screen",
                sigterm_timeout="30",  # a thousand turtles take seconds to leave, and longer on a busy machine
            ),
        ]
    )
