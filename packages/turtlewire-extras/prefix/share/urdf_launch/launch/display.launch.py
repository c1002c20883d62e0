"""Shows a robot with sliders for its joints, in RViz, which here opens the 3D view."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Return the description of the robot, the sliders and the view."""
    here = FindPackageShare("urdf_launch")
    gui = LaunchConfiguration("jsp_gui")
    return LaunchDescription(
        [
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
            DeclareLaunchArgument(
                "urdf_package", description="The package where the robot description is located"
            ),
            DeclareLaunchArgument(
                "urdf_package_path",
                description="The path to the robot description relative to the package root",
            ),
            IncludeLaunchDescription(
                PathJoinSubstitution([here, "launch", "description.launch.py"]),
                launch_arguments=[
                    (name, LaunchConfiguration(name))
                    for name in ("urdf_package", "urdf_package_path")
                ],
            ),
            # Depending on the argument, the joints have sliders or stay where they are.
            Node(
                condition=UnlessCondition(gui),
                package="joint_state_publisher",
                executable="joint_state_publisher",
            ),
            Node(
                condition=IfCondition(gui),
                package="joint_state_publisher_gui",
                executable="joint_state_publisher_gui",
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                output="screen",
                arguments=["-d", LaunchConfiguration("rviz_config")],
            ),
        ]
    )
