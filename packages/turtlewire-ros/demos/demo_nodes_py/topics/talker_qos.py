"""Says ``Hello World`` on ``chatter``, reliably or with best effort."""

from __future__ import annotations

from demo_nodes_py.topics.qos_options import profile, run_cycles
from rclpy.node import Node
from std_msgs.msg import String


class TalkerQos(Node):
    """Publishes a counted greeting every second.

    Args:
        reliable: Whether lost messages are sent again.
    """

    def __init__(self, reliable: bool) -> None:
        super().__init__("talker_qos")
        self._count = 0
        self.get_logger().info("Reliable talker" if reliable else "Best effort talker")
        self._publisher = self.create_publisher(String, "chatter", profile(reliable=reliable))
        self.create_timer(1.0, self._talk)

    def _talk(self) -> None:
        message = String(data=f"Hello World: {self._count}")
        self._count += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self._publisher.publish(message)


def main(args: list[str] | None = None) -> None:
    """Talk until Ctrl-C or for ``-n`` cycles."""
    run_cycles(TalkerQos, "talker", args)
