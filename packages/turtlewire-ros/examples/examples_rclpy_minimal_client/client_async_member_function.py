"""A client whose request is a method of the node."""

from __future__ import annotations

import contextlib
import sys

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args


class MinimalClientAsync(Node):
    """Waits for the service at construction, then asks it."""

    def __init__(self) -> None:
        super().__init__("minimal_client_async")
        self.cli = self.create_client(AddTwoInts, "add_two_ints")
        while not self.cli.wait_for_service(timeout_sec=1.0):
            if not rclpy.ok():
                raise ExternalShutdownException
            self.get_logger().info("service not available, waiting again...")

    def send_request(self, a: int, b: int) -> AddTwoInts.Response | None:
        """Return the service's answer; None if rclpy was shut down before."""
        future = self.cli.call_async(AddTwoInts.Request(a=a, b=b))
        rclpy.spin_until_future_complete(self, future)
        return future.result()


def main(args: list[str] | None = None) -> None:
    """Ask for the sum of the two numbers of the command line (41 and 1 without)."""
    numbers = remove_ros_args(sys.argv if args is None else ["", *args])[1:]
    a, b = (int(number) for number in numbers[:2]) if len(numbers) >= 2 else (41, 1)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = MinimalClientAsync()
        answer = node.send_request(a, b)
        if answer is not None:
            node.get_logger().info(f"Result of add_two_ints: for {a} + {b} = {answer.sum}")
