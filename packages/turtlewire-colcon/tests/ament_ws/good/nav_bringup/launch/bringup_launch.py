from launch import LaunchDescription
from launch.actions import LogInfo
from nav_common.launch import prefixed


def generate_launch_description():
    return LaunchDescription([LogInfo(msg=prefixed("bringup"))])
