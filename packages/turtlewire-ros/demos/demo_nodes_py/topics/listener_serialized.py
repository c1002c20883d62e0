"""Logs the bytes of the messages on ``chatter``."""

from __future__ import annotations

from demo_nodes_py.spin import spin
from rclpy.node import Node
from std_msgs.msg import String


class SerializedSubscriber(Node):
    """Logs each greeting as it came, serialized."""

    def __init__(self) -> None:
        super().__init__("serialized_subscriber")
        self.create_subscription(String, "chatter", self._hear, 10, raw=True)

    def _hear(self, message: bytes) -> None:
        self.get_logger().info(f'I heard: "{message!r}"')


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    spin(SerializedSubscriber, args)
