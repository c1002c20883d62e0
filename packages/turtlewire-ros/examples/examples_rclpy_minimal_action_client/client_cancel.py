"""An action client that cancels its goal after two seconds."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

if TYPE_CHECKING:
    from rclpy.task import Future


class MinimalActionClient(Node):
    """Asks for the Fibonacci sequence of order 10, and cancels the goal two seconds later."""

    def __init__(self) -> None:
        super().__init__("minimal_action_client")
        self._client = ActionClient(self, Fibonacci, "fibonacci")
        self._goal_handle: Any = None

    def send_goal(self) -> None:
        """Wait for the server and send it the goal."""
        self.get_logger().info("Waiting for action server...")
        if not self._client.wait_for_server():
            raise ExternalShutdownException
        self.get_logger().info("Sending goal request...")
        future = self._client.send_goal_async(
            Fibonacci.Goal(order=10), feedback_callback=self.feedback_callback
        )
        future.add_done_callback(self.goal_response_callback)

    def goal_response_callback(self, future: Future[Any]) -> None:
        """Start the timer that cancels the goal if it was accepted."""
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().info("Goal rejected :(")
            return
        self._goal_handle = goal_handle
        self.get_logger().info("Goal accepted :)")
        self._timer = self.create_timer(2.0, self.timer_callback)

    def feedback_callback(self, feedback: Any) -> None:
        """Log how far the server is."""
        self.get_logger().info(f"Received feedback: {feedback.feedback.sequence}")

    def timer_callback(self) -> None:
        """Cancel the goal, once."""
        self.get_logger().info("Canceling goal")
        self._goal_handle.cancel_goal_async().add_done_callback(self.cancel_done)
        # A timer repeats until it is cancelled.
        self._timer.cancel()

    def cancel_done(self, future: Future[Any]) -> None:
        """Log whether the goal was cancelled and shut down."""
        if len(future.result().goals_canceling) > 0:
            self.get_logger().info("Goal successfully canceled")
        else:
            self.get_logger().info("Goal failed to cancel")
        rclpy.shutdown()


def main(args: list[str] | None = None) -> None:
    """Send one goal and cancel it."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = MinimalActionClient()
        node.send_goal()
        rclpy.spin(node)
