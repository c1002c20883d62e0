"""Turtles that follow one another: `ros2 launch learning_tf2_py swarm.launch.py count:=1000`."""

from importlib.util import find_spec

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

# turtlewire's simulator is a Python module and shares a process with the swarm: that carries a
# thousand turtles. ROS 2's simulator is a C++ program; topics carry some hundreds.
SIMULATOR_IS_A_MODULE = find_spec("turtlesim.turtlesim_node") is not None


def generate_launch_description():
    swarm = Node(
        package="learning_tf2_py",
        executable="swarm_with_simulator" if SIMULATOR_IS_A_MODULE else "swarm",
        parameters=[{"count": LaunchConfiguration("count")}],
        output="screen",
        sigterm_timeout="30",  # a thousand turtles need seconds to leave the graph
    )
    simulator = Node(package="turtlesim", executable="turtlesim_node")
    return LaunchDescription(
        [
            DeclareLaunchArgument("count", default_value="1000", description="How many turtles."),
            *([] if SIMULATOR_IS_A_MODULE else [simulator]),
            swarm,
        ]
    )
