"""An action client: sends a goal, logs the feedback and the result, and ends."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

import rclpy
from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

if TYPE_CHECKING:
    from rclpy.task import Future


class MinimalActionClient(Node):
    """Asks for the Fibonacci sequence of order 10."""

    def __init__(self) -> None:
        super().__init__("minimal_action_client")
        self._client = ActionClient(self, Fibonacci, "fibonacci")

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
        """Ask for the result if the goal was accepted."""
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().info("Goal rejected :(")
            return
        self.get_logger().info("Goal accepted :)")
        goal_handle.get_result_async().add_done_callback(self.get_result_callback)

    def feedback_callback(self, feedback: Any) -> None:
        """Log how far the server is."""
        self.get_logger().info(f"Received feedback: {feedback.feedback.sequence}")

    def get_result_callback(self, future: Future[Any]) -> None:
        """Log the result and shut down."""
        answer = future.result()
        if answer.status == GoalStatus.STATUS_SUCCEEDED:
            self.get_logger().info(f"Goal succeeded! Result: {answer.result.sequence}")
        else:
            self.get_logger().info(f"Goal failed with status: {answer.status}")
        # Lets `rclpy.spin` in `main` return.
        rclpy.shutdown()


def main(args: list[str] | None = None) -> None:
    """Send one goal and wait for its result."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = MinimalActionClient()
        node.send_goal()
        rclpy.spin(node)
