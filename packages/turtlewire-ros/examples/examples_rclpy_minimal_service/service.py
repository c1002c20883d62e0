"""A service answered by a function."""

from __future__ import annotations

import contextlib

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import ExternalShutdownException


def main(args: list[str] | None = None) -> None:
    """Serve until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_service")

        def add(request: AddTwoInts.Request, response: AddTwoInts.Response) -> AddTwoInts.Response:
            response.sum = request.a + request.b
            node.get_logger().info(f"Incoming request\na: {request.a} b: {request.b}")
            return response

        node.create_service(AddTwoInts, "add_two_ints", add)
        rclpy.spin(node)
