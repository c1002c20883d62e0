"""Fixes a carrot two metres to the left of turtle1: a frame that moves with its parent."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import TransformBroadcaster


class FixedFrameBroadcaster(Node):
    """Broadcasts the carrot ten times a second, always in the same place relative to turtle1."""

    def __init__(self):
        super().__init__("fixed_frame_tf2_broadcaster")
        self.broadcaster = TransformBroadcaster(self)
        self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "turtle1"
        t.child_frame_id = "carrot1"
        t.transform.translation.y = 2.0
        self.broadcaster.sendTransform(t)


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(FixedFrameBroadcaster())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
