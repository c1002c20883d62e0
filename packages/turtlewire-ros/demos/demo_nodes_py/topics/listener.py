"""Logs the messages on ``chatter``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from demo_nodes_py.spin import spin
from rclpy.node import Node
from std_msgs.msg import String

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile


class Listener(Node):
    """Logs each greeting."""

    def __init__(self, name: str = "listener", qos: QoSProfile | int = 10) -> None:
        super().__init__(name)
        self.create_subscription(String, "chatter", self._hear, qos)

    def _hear(self, message: String) -> None:
        self.get_logger().info(f"I heard: [{message.data}]")


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    spin(Listener, args)
