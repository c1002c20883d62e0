"""A publisher whose timer calls a local function."""

from __future__ import annotations

import contextlib
import itertools

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main(args: list[str] | None = None) -> None:
    """Publish until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_publisher")
        publisher = node.create_publisher(String, "topic", 10)
        numbers = itertools.count()

        def publish() -> None:
            message = String(data=f"Hello World: {next(numbers)}")
            node.get_logger().info(f'Publishing: "{message.data}"')
            publisher.publish(message)

        node.create_timer(0.5, publish)
        rclpy.spin(node)
