"""A client whose request is awaited in the callback of a timer."""

from __future__ import annotations

import contextlib

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException
from rclpy.task import Future


def main(args: list[str] | None = None) -> None:
    """Ask for 41 + 1, once, half a second after the service is available, and log the answer."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_client")
        # In the node's own group, the answer and the callback would wait for each other.
        group = ReentrantCallbackGroup()
        client = node.create_client(AddTwoInts, "add_two_ints", callback_group=group)
        answered: Future[AddTwoInts.Response] = Future()

        async def call_service() -> None:
            # First, because the timer would ask again during the wait.
            timer.cancel()
            request = AddTwoInts.Request(a=41, b=1)
            answer = await client.call_async(request)
            node.get_logger().info(
                f"Result of add_two_ints: for {request.a} + {request.b} = {answer.sum}"
            )
            answered.set_result(answer)

        while not client.wait_for_service(timeout_sec=1.0):
            if not rclpy.ok():
                raise ExternalShutdownException
            node.get_logger().info("service not available, waiting again...")
        timer = node.create_timer(0.5, call_service, callback_group=group)
        rclpy.spin_until_future_complete(node, answered)
