"""Says ``Hello World`` on ``chatter`` once a second."""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Publishes a counted greeting every second."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.i = 0
        self.pub = self.create_publisher(String, "chatter", 10)
        self.tmr = self.create_timer(1.0, self.timer_callback)

    def timer_callback(self) -> None:
        """Publish one greeting."""
        message = String(data=f"Hello World: {self.i}")
        self.i += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.pub.publish(message)


def main(args: list[str] | None = None) -> None:
    """Talk until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(Talker())
