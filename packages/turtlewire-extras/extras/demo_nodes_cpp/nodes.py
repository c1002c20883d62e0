"""The nodes: ``talker`` and ``listener``, a service with its clients, and a node of parameters."""

from __future__ import annotations

import contextlib

import rclpy
from demo_nodes_py.services.add_two_ints_server import AddTwoIntsServer as ServerNode
from demo_nodes_py.spin import spin
from demo_nodes_py.topics.listener import Listener
from example_interfaces.srv import AddTwoInts
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

__all__ = [
    "Listener",
    "ParameterBlackboard",
    "ServerNode",
    "Talker",
    "add_two_ints_client",
    "add_two_ints_server",
    "listener",
    "parameter_blackboard",
    "talker",
]


class Talker(Node):
    """Publishes a counted greeting every second."""

    def __init__(self) -> None:
        super().__init__("talker")
        self._count = 1
        self._publisher = self.create_publisher(String, "chatter", 7)
        self.create_timer(1.0, self._talk)

    def _talk(self) -> None:
        message = String(data=f"Hello World: {self._count}")
        self._count += 1
        self.get_logger().info(f"Publishing: '{message.data}'")
        self._publisher.publish(message)


def talker(args: list[str] | None = None) -> None:
    """Talk until Ctrl-C."""
    spin(Talker, args)


def listener(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C."""
    spin(Listener, args)


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


class ParameterBlackboard(Node):
    """Accepts every parameter."""

    def __init__(self) -> None:
        super().__init__(
            "parameter_blackboard",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        count = len(self.list_parameters([], 0).names)
        self.get_logger().info(
            f"Parameter blackboard node named '{self.get_fully_qualified_name()}' ready, and "
            f"serving '{count}' parameters already!"
        )


def parameter_blackboard(args: list[str] | None = None) -> None:
    """Hold parameters until Ctrl-C."""
    spin(ParameterBlackboard, args)
