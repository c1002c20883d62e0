"""An action server: a goal's callback publishes feedback once a second and can be cancelled."""

from __future__ import annotations

import contextlib
import time
from typing import Any

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class MinimalActionServer(Node):
    """Computes Fibonacci sequences, several at a time."""

    def __init__(self) -> None:
        super().__init__("minimal_action_server")
        self._server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            execute_callback=self.execute_callback,
            # Allows goals to run concurrently, and accepts cancellations while they run.
            callback_group=ReentrantCallbackGroup(),
            goal_callback=self.goal_callback,
            cancel_callback=self.cancel_callback,
        )

    def destroy_node(self) -> None:
        """Close the action server, then the node."""
        self._server.destroy()
        super().destroy_node()

    def goal_callback(self, _goal_request: Any) -> GoalResponse:
        """Accept every goal."""
        self.get_logger().info("Received goal request")
        return GoalResponse.ACCEPT

    def cancel_callback(self, _goal_handle: Any) -> CancelResponse:
        """Accept every cancellation."""
        self.get_logger().info("Received cancel request")
        return CancelResponse.ACCEPT

    def execute_callback(self, goal_handle: Any) -> Fibonacci.Result:
        """Compute one sequence; runs on a thread of the executor."""
        self.get_logger().info("Executing goal...")
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(1, goal_handle.request.order):
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                self.get_logger().info("Goal canceled")
                return Fibonacci.Result()
            feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
            self.get_logger().info(f"Publishing feedback: {feedback.sequence}")
            goal_handle.publish_feedback(feedback)
            # Blocks one thread only; the executor has others.
            time.sleep(1)
        goal_handle.succeed()
        result = Fibonacci.Result(sequence=feedback.sequence)
        self.get_logger().info(f"Returning result: {result.sequence}")
        return result


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(MinimalActionServer(), executor=MultiThreadedExecutor())
