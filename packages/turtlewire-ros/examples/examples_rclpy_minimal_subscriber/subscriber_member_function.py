"""A subscription that calls a method of the node."""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class MinimalSubscriber(Node):
    """Logs the messages it receives."""

    def __init__(self) -> None:
        super().__init__("minimal_subscriber")
        self.subscription = self.create_subscription(String, "topic", self.listener_callback, 10)

    def listener_callback(self, msg: String) -> None:
        """Log one message."""
        self.get_logger().info(f'I heard: "{msg.data}"')


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(MinimalSubscriber())
