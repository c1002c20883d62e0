"""A client that spins until its answer has arrived."""

from __future__ import annotations

import contextlib

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import ExternalShutdownException


def main(args: list[str] | None = None) -> None:
    """Ask for 41 + 1 and log the answer."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_client")
        client = node.create_client(AddTwoInts, "add_two_ints")
        request = AddTwoInts.Request(a=41, b=1)
        while not client.wait_for_service(timeout_sec=1.0):
            if not rclpy.ok():
                raise ExternalShutdownException
            node.get_logger().info("service not available, waiting again...")
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future)
        answer = future.result()
        if answer is not None:
            node.get_logger().info(
                f"Result of add_two_ints: for {request.a} + {request.b} = {answer.sum}"
            )
        else:
            node.get_logger().error(f"Exception while calling service: {future.exception()!r}")
