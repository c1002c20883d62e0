"""The follow demo: turtle2 goes where turtle1 was five seconds ago."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    demo = PathJoinSubstitution(
        [FindPackageShare("learning_tf2_py"), "launch", "turtle_tf2_demo.launch.py"]
    )
    arguments = {"listener": "turtle_tf2_time_travel"}
    return LaunchDescription(
        [
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(demo), launch_arguments=arguments.items()
            )
        ]
    )
