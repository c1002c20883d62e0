"""Moves a carrot around turtle1: a frame whose position in its parent changes over time."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import TransformBroadcaster


class DynamicFrameBroadcaster(Node):
    """Broadcasts the carrot ten times a second, on a circle of ten metres around turtle1."""

    def __init__(self):
        super().__init__("dynamic_frame_tf2_broadcaster")
        self.broadcaster = TransformBroadcaster(self)
        self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        now = self.get_clock().now()
        angle = math.pi * now.nanoseconds / 1e9

        t = TransformStamped()
        t.header.stamp = now.to_msg()
        t.header.frame_id = "turtle1"
        t.child_frame_id = "carrot1"
        t.transform.translation.x = 10.0 * math.sin(angle)
        t.transform.translation.y = 10.0 * math.cos(angle)
        self.broadcaster.sendTransform(t)


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(DynamicFrameBroadcaster())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
