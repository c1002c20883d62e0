"""A publisher whose timer calls a method of the node."""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class MinimalPublisher(Node):
    """Publishes a counted greeting twice a second."""

    def __init__(self) -> None:
        super().__init__("minimal_publisher")
        self.publisher_ = self.create_publisher(String, "topic", 10)
        self.timer = self.create_timer(0.5, self.timer_callback)
        self.i = 0

    def timer_callback(self) -> None:
        """Publish the next greeting."""
        message = String(data=f"Hello World: {self.i}")
        self.publisher_.publish(message)
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.i += 1


def main(args: list[str] | None = None) -> None:
    """Publish until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(MinimalPublisher())
