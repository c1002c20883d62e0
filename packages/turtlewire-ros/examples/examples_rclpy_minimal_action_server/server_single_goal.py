"""An action server with one goal at a time: a new goal aborts the running one."""

from __future__ import annotations

import contextlib
import time
from threading import Lock
from typing import Any

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class MinimalActionServer(Node):
    """Computes one Fibonacci sequence at a time, that of the latest goal."""

    def __init__(self) -> None:
        super().__init__("minimal_action_server")
        self._goal_handle: Any = None
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
        """Abort the running goal, if any, and execute the new one."""
        with self._goal_lock:
            if self._goal_handle is not None and self._goal_handle.is_active:
                self.get_logger().info("Aborting previous goal")
                self._goal_handle.abort()
            self._goal_handle = goal_handle
        goal_handle.execute()

    def cancel_callback(self, _goal_handle: Any) -> CancelResponse:
        """Accept every cancellation."""
        self.get_logger().info("Received cancel request")
        return CancelResponse.ACCEPT

    def is_stopped(self, goal_handle: Any) -> bool:
        """Return True if a new goal or a client has stopped this one; the lock keeps them apart."""
        with self._goal_lock:
            if not goal_handle.is_active:
                self.get_logger().info("Goal aborted")
                return True
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                self.get_logger().info("Goal canceled")
                return True
        return False

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
            time.sleep(1)
        # A new goal may have aborted this one during the last sleep.
        with self._goal_lock:
            if not goal_handle.is_active:
                self.get_logger().info("Goal aborted")
                return Fibonacci.Result()
            goal_handle.succeed()
        result = Fibonacci.Result(sequence=feedback.sequence)
        self.get_logger().info(f"Returning result: {result.sequence}")
        return result


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(MinimalActionServer(), executor=MultiThreadedExecutor())
