"""Asks ``add_two_ints`` for 2 + 3 and spins in a loop until the answer has arrived."""

from __future__ import annotations

import contextlib

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import ExternalShutdownException


def main(args: list[str] | None = None) -> None:
    """Wait for the service, ask once and log the answer."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("add_two_ints_client")
        client = node.create_client(AddTwoInts, "add_two_ints")
        while not client.wait_for_service(timeout_sec=1.0):
            if not rclpy.ok():
                raise ExternalShutdownException
            print("service not available, waiting again...", flush=True)  # noqa: T201 - as in ROS 2
        future = client.call_async(AddTwoInts.Request(a=2, b=3))
        while rclpy.ok() and not future.done():
            rclpy.spin_once(node)
        answer = future.result()
        if answer is not None:
            node.get_logger().info(f"Result of add_two_ints: {answer.sum}")
        else:
            node.get_logger().error(f"Exception while calling service: {future.exception()!r}")
