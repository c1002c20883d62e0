"""Logs the messages on ``chatter``, reliably or with best effort."""

from __future__ import annotations

from demo_nodes_py.topics.qos_options import profile, run_cycles
from rclpy.node import Node
from std_msgs.msg import String


class ListenerQos(Node):
    """Logs each greeting.

    Args:
        reliable: Whether lost messages are asked for again; a best-effort talker does not match
            then.
    """

    def __init__(self, reliable: bool) -> None:
        super().__init__("listener_qos")
        self.get_logger().info("Reliable listener" if reliable else "Best effort listener")
        self.create_subscription(String, "chatter", self._hear, profile(reliable=reliable))

    def _hear(self, message: String) -> None:
        self.get_logger().info(f"I heard: [{message.data}]")


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C or for ``-n`` cycles."""
    run_cycles(ListenerQos, "listener", args)
