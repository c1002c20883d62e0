"""An action server: a goal's callback publishes feedback once a second and can be cancelled."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable
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
            handle_accepted_callback=self.handle_accepted_callback,
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

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """Execute the goal."""
        goal_handle.execute()

    def cancel_callback(self, _goal_handle: Any) -> CancelResponse:
        """Accept every cancellation."""
        self.get_logger().info("Received cancel request")
        return CancelResponse.ACCEPT

    def execute_callback(self, goal_handle: Any) -> Fibonacci.Result:
        """Compute one sequence; runs on a thread of the executor."""
        self.get_logger().info("Executing goal...")
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(1, goal_handle.request.order):
            if self.is_stopped(goal_handle):
                return Fibonacci.Result()
            feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
            self.get_logger().info(f"Publishing feedback: {feedback.sequence}")
            goal_handle.publish_feedback(feedback)
            # Blocks one thread only; the executor has others.
            time.sleep(1)
        if not self.succeed(goal_handle):
            return Fibonacci.Result()
        result = Fibonacci.Result(sequence=feedback.sequence)
        self.get_logger().info(f"Returning result: {result.sequence}")
        return result

    def is_stopped(self, goal_handle: Any) -> bool:
        """Return True if a client has cancelled the goal."""
        if not goal_handle.is_cancel_requested:
            return False
        goal_handle.canceled()
        self.get_logger().info("Goal canceled")
        return True

    def succeed(self, goal_handle: Any) -> bool:
        """Let the goal succeed; return False if it was stopped before."""
        goal_handle.succeed()
        return True


def serve(make_server: Callable[[], MinimalActionServer], args: list[str] | None) -> None:
    """Make a server and serve goals until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(make_server(), executor=MultiThreadedExecutor())


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    serve(MinimalActionServer, args)
