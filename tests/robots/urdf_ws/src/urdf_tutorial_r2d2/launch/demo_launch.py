import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    use_sim_time = LaunchConfiguration("use_sim_time", default="false")
    share = get_package_share_directory("urdf_tutorial_r2d2")
    urdf = os.path.join(share, "urdf", "r2d2.urdf.xml")
    with open(urdf, encoding="utf-8") as file:
        description = file.read()
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "use_sim_time",
                default_value="false",
                description="Use simulation (Gazebo) clock if true",
            ),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                name="robot_state_publisher",
                output="screen",
                parameters=[{"use_sim_time": use_sim_time, "robot_description": description}],
                arguments=[urdf],
            ),
            Node(
                package="urdf_tutorial_r2d2",
                executable="state_publisher",
                name="state_publisher",
                output="screen",
            ),
        ]
    )
