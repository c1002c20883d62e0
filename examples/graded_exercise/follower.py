"""The submission: drives turtle2 after turtle1."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener


class Follower(Node):
    """Looks ten times a second where turtle1 is, as turtle2 sees it, and steers there."""

    def __init__(self) -> None:
        super().__init__("follower")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(Twist, "/turtle2/cmd_vel", 1)
        self.create_timer(0.1, self.on_timer)

    def on_timer(self) -> None:
        """Steer, once both turtles are known."""
        try:
            transform = self.buffer.lookup_transform("turtle2", "turtle1", Time())
        except TransformException:
            return
        target = transform.transform.translation
        command = Twist()
        command.linear.x = 0.5 * math.hypot(target.x, target.y)
        command.angular.z = 1.0 * math.atan2(target.y, target.x)
        self.publisher.publish(command)


def main() -> None:
    """Run it on a real simulator: `python follower.py`."""
    rclpy.init()
    rclpy.spin(Follower())


if __name__ == "__main__":
    main()
