"""Logs the messages on ``chatter``."""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Listener(Node):
    """Logs each greeting."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.sub = self.create_subscription(String, "chatter", self.chatter_callback, 10)

    def chatter_callback(self, message: String) -> None:
        """Log one greeting."""
        self.get_logger().info(f'I heard: "{message.data}"')


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(Listener())
