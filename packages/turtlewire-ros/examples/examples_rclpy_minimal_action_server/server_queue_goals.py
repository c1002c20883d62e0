"""An action server that executes its goals one after the other."""

from __future__ import annotations

import contextlib
import time
from collections import deque
from threading import Lock
from typing import Any

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class MinimalActionServer(Node):
    """Computes one Fibonacci sequence at a time; the other goals wait."""

    def __init__(self) -> None:
        super().__init__("minimal_action_server")
        self._waiting: deque[Any] = deque()
        self._current_goal: Any = None
        self._goal_lock = Lock()
        self._server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            execute_callback=self.execute_callback,
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
        """Execute the goal if no other one is running; else it waits."""
        with self._goal_lock:
            if self._current_goal is not None:
                self._waiting.append(goal_handle)
                self.get_logger().info("Goal put in the queue")
                return
            self._current_goal = goal_handle
        goal_handle.execute()

    def cancel_callback(self, _goal_handle: Any) -> CancelResponse:
        """Accept every cancellation."""
        self.get_logger().info("Received cancel request")
        return CancelResponse.ACCEPT

    def execute_callback(self, goal_handle: Any) -> Fibonacci.Result:
        """Compute one sequence, then start the goal that has waited longest."""
        try:
            return self.compute(goal_handle)
        # Also after a cancellation or an error; the other goals would wait forever.
        finally:
            self.start_next_goal()

    def start_next_goal(self) -> None:
        """Execute the goal that has waited longest, if any."""
        with self._goal_lock:
            self._current_goal = self._waiting.popleft() if self._waiting else None
            if self._current_goal is not None:
                self.get_logger().info("Next goal pulled from the queue")
                self._current_goal.execute()

    def compute(self, goal_handle: Any) -> Fibonacci.Result:
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
            time.sleep(1)
        goal_handle.succeed()
        result = Fibonacci.Result(sequence=feedback.sequence)
        self.get_logger().info(f"Returning result: {result.sequence}")
        return result


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(MinimalActionServer(), executor=MultiThreadedExecutor())
