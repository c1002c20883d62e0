"""The follow demo: turtle2 follows the carrot of the dynamic frame broadcaster."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    demo = PathJoinSubstitution(
        [FindPackageShare("learning_tf2_py"), "launch", "turtle_tf2_demo.launch.py"]
    )
    return LaunchDescription(
        [
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(demo),
                launch_arguments={"target_frame": "carrot1"}.items(),
            ),
            Node(
                package="learning_tf2_py",
                executable="dynamic_frame_tf2_broadcaster",
                name="dynamic_broadcaster",
            ),
        ]
    )
