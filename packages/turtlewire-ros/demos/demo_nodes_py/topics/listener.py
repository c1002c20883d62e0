"""Logs the messages on ``chatter``."""

from __future__ import annotations

from demo_nodes_py.spin import spin
from rclpy.node import Node
from std_msgs.msg import String


class Listener(Node):
    """Logs each greeting."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.create_subscription(String, "chatter", self._hear, 10)

    def _hear(self, message: String) -> None:
        self.get_logger().info(f"I heard: [{message.data}]")


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    spin(Listener, args)
