from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    here = FindPackageShare("urdf_launch")
    gui = LaunchConfiguration("jsp_gui")
    return LaunchDescription(
        [
            DeclareLaunchArgument("urdf_package", description="The package of the robot"),
            DeclareLaunchArgument("urdf_package_path", description="The robot's file in it"),
            DeclareLaunchArgument(
                "jsp_gui",
                default_value="true",
                choices=["true", "false"],
                description="Flag to enable joint_state_publisher_gui",
            ),
            DeclareLaunchArgument(
                "rviz_config",
                default_value=PathJoinSubstitution([here, "config", "urdf.rviz"]),
                description="Absolute path to rviz config file",
            ),
            IncludeLaunchDescription(
                PathJoinSubstitution([here, "launch", "description.launch.py"]),
                launch_arguments={
                    "urdf_package": LaunchConfiguration("urdf_package"),
                    "urdf_package_path": LaunchConfiguration("urdf_package_path"),
                }.items(),
            ),
            Node(
                package="joint_state_publisher",
                executable="joint_state_publisher",
                condition=UnlessCondition(gui),
            ),
            Node(
                package="joint_state_publisher_gui",
                executable="joint_state_publisher_gui",
                condition=IfCondition(gui),
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                output="screen",
                arguments=["-d", LaunchConfiguration("rviz_config")],
            ),
        ]
    )
