"""Says ``Hello World`` on ``chatter`` once a second."""

from __future__ import annotations

from demo_nodes_py.spin import spin
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Publishes a counted greeting every second."""

    def __init__(self) -> None:
        super().__init__("talker")
        self._count = 0
        self._publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(1.0, self._talk)

    def _talk(self) -> None:
        message = String(data=f"Hello World: {self._count}")
        self._count += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self._publisher.publish(message)


def main(args: list[str] | None = None) -> None:
    """Talk until Ctrl-C."""
    spin(Talker, args)
