"""A client that looks for its answer between calls of ``spin_once``."""

from __future__ import annotations

import contextlib

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import ExternalShutdownException


def main(args: list[str] | None = None) -> None:
    """Ask for 41 + 1 and log the answer."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_client_async")
        client = node.create_client(AddTwoInts, "add_two_ints")
        request = AddTwoInts.Request(a=41, b=1)
        while not client.wait_for_service(timeout_sec=1.0):
            if not rclpy.ok():
                raise ExternalShutdownException
            node.get_logger().info("service not available, waiting again...")
        future = client.call_async(request)
        while rclpy.ok() and not future.done():
            rclpy.spin_once(node)
        if (answer := future.result()) is not None:
            node.get_logger().info(
                f"Result of add_two_ints: for {request.a} + {request.b} = {answer.sum}"
            )
