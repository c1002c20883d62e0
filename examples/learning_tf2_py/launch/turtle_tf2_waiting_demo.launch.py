"""The follow demo with lookups that wait: `waiting:=blocking` or `waiting:=async`."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    demo = PathJoinSubstitution(
        [FindPackageShare("learning_tf2_py"), "launch", "turtle_tf2_demo.launch.py"]
    )
    listener = ["turtle_tf2_", LaunchConfiguration("waiting"), "_listener"]
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "waiting",
                default_value="blocking",
                choices=["blocking", "async"],
                description="How the listener waits.",
            ),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(demo), launch_arguments={"listener": listener}.items()
            ),
        ]
    )
