"""A subscription that calls a lambda."""

from __future__ import annotations

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_subscriber")
        node.create_subscription(
            String, "topic", lambda msg: node.get_logger().info(f'I heard: "{msg.data}"'), 10
        )
        rclpy.spin(node)
