"""The simulator, a broadcaster for each turtle, and the listener that drives turtle2."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "target_frame",
                default_value="turtle1",
                description="The frame that turtle2 follows.",
            ),
            DeclareLaunchArgument(
                "listener",
                default_value="turtle_tf2_listener",
                description="The executable that drives turtle2.",
            ),
            Node(package="turtlesim", executable="turtlesim_node", name="sim"),
            Node(
                package="learning_tf2_py",
                executable="turtle_tf2_broadcaster",
                name="broadcaster1",
                parameters=[{"turtlename": "turtle1"}],
            ),
            Node(
                package="learning_tf2_py",
                executable="turtle_tf2_broadcaster",
                name="broadcaster2",
                parameters=[{"turtlename": "turtle2"}],
            ),
            Node(
                package="learning_tf2_py",
                executable=LaunchConfiguration("listener"),
                name="listener",
                parameters=[{"target_frame": LaunchConfiguration("target_frame")}],
            ),
        ]
    )
