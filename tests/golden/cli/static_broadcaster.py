"""The static broadcaster that ran during captures 174 to 326: a node of C++."""

from __future__ import annotations

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from tf2_ros import StaticTransformBroadcaster
from turtlesim.cpp_node import CppNode


def main() -> None:
    """Publish until Ctrl-C."""
    rclpy.init()
    node = CppNode("static_turtle_tf2_broadcaster")
    transform = TransformStamped()
    transform.header.stamp = node.get_clock().now().to_msg()
    transform.header.frame_id, transform.child_frame_id = "world", "mystaticturtle"
    transform.transform.translation.z = 1.0
    broadcaster = StaticTransformBroadcaster(node)
    broadcaster.sendTransform(transform)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        node.destroy_node()


if __name__ == "__main__":
    main()
