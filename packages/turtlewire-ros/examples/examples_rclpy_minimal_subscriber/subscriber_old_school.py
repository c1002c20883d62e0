"""A subscription served by ``spin_once`` in a loop."""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_subscriber")

        def hear(message: String) -> None:
            node.get_logger().info(f'I heard: "{message.data}"')

        node.create_subscription(String, "topic", hear, 10)
        while rclpy.ok():
            rclpy.spin_once(node)
