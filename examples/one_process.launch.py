"""The tutorial's demo in one process: ``ros2 launch examples/one_process.launch.py``."""

from __future__ import annotations

from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode

BROADCASTER = "learning_tf2_py.turtle_tf2_broadcaster.TurtleBroadcaster"
LISTENER = "learning_tf2_py.turtle_tf2_listener.TurtleListener"


def generate_launch_description() -> LaunchDescription:
    """Return the same nodes, names and parameters as in ``turtle_tf2_demo.launch.py``."""
    nodes = [
        ComposableNode(
            package="turtlesim", plugin="turtlesim.turtlesim_node.TurtlesimNode", name="sim"
        ),
        ComposableNode(
            package="learning_tf2_py",
            plugin=BROADCASTER,
            name="broadcaster1",
            parameters=[{"turtlename": "turtle1"}],
        ),
        ComposableNode(
            package="learning_tf2_py",
            plugin=BROADCASTER,
            name="broadcaster2",
            parameters=[{"turtlename": "turtle2"}],
        ),
        ComposableNode(
            package="learning_tf2_py",
            plugin=LISTENER,
            name="listener",
            parameters=[{"target_frame": "turtle1"}],
        ),
    ]
    return LaunchDescription(
        [ComposableNodeContainer(name="demo", output="screen", composable_node_descriptions=nodes)]
    )
