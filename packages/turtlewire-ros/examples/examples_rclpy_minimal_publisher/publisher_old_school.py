"""A publisher in a loop that sleeps: no timer, no executor."""

from __future__ import annotations

import contextlib
import itertools
from time import sleep

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main(args: list[str] | None = None) -> None:
    """Publish until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_publisher")
        publisher = node.create_publisher(String, "topic", 10)
        # Nothing is spun: publishing needs no executor, and there are no callbacks.
        for number in itertools.count():
            if not rclpy.ok():
                break
            message = String(data=f"Hello World: {number}")
            node.get_logger().info(f'Publishing: "{message.data}"')
            publisher.publish(message)
            sleep(0.5)
