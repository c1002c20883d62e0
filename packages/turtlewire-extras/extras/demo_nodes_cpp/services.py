"""A service that adds two integers, and a client that asks it for 2 + 3."""

from __future__ import annotations

import contextlib

import rclpy
from demo_nodes_py.services.add_two_ints_server import AddTwoIntsServer as ServerNode
from demo_nodes_py.spin import spin
from example_interfaces.srv import AddTwoInts
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException

__all__ = ["ServerNode", "add_two_ints_client", "add_two_ints_server"]


def add_two_ints_server(args: list[str] | None = None) -> None:
    """Add until Ctrl-C."""
    spin(ServerNode, args)


def add_two_ints_client(args: list[str] | None = None) -> None:
    """Wait for the service, ask once and log the answer."""
    # RCLError: after SIGTERM, the context of the waiting client is invalid.
    ended = contextlib.suppress(KeyboardInterrupt, ExternalShutdownException, RCLError)
    with ended, rclpy.init(args=args):
        node = rclpy.create_node("add_two_ints_client")
        client = node.create_client(AddTwoInts, "add_two_ints")
        while not client.wait_for_service(timeout_sec=1.0):
            node.get_logger().info("service not available, waiting again...")
        future = client.call_async(AddTwoInts.Request(a=2, b=3))
        rclpy.spin_until_future_complete(node, future)
        if answer := future.result():
            node.get_logger().info(f"Result of add_two_ints: {answer.sum}")
