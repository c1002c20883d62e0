from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                name="gui",
                default_value="true",
                choices=["true", "false"],
                description="Flag to enable joint_state_publisher_gui",
            ),
            DeclareLaunchArgument(
                name="model",
                default_value="urdf/01-myfirst.urdf",
                description="Path to robot urdf file relative to urdf_tutorial package",
            ),
            IncludeLaunchDescription(
                PathJoinSubstitution(
                    [FindPackageShare("urdf_launch"), "launch", "display.launch.py"]
                ),
                launch_arguments={
                    "urdf_package": "urdf_tutorial",
                    "urdf_package_path": LaunchConfiguration("model"),
                    "jsp_gui": LaunchConfiguration("gui"),
                }.items(),
            ),
        ]
    )
