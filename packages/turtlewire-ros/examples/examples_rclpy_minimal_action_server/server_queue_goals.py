"""An action server that executes its goals one after the other."""

from __future__ import annotations

from collections import deque
from threading import Lock
from typing import TYPE_CHECKING, Any

from examples_rclpy_minimal_action_server import server

if TYPE_CHECKING:
    from example_interfaces.action import Fibonacci


class MinimalActionServer(server.MinimalActionServer):
    """Computes one Fibonacci sequence at a time; the other goals wait."""

    def __init__(self) -> None:
        super().__init__()
        self._waiting: deque[Any] = deque()
        self._current_goal: Any = None
        self._goal_lock = Lock()

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """Execute the goal if no other one is running; else it waits."""
        with self._goal_lock:
            if self._current_goal is not None:
                self._waiting.append(goal_handle)
                self.get_logger().info("Goal put in the queue")
                return
            self._current_goal = goal_handle
        goal_handle.execute()

    def execute_callback(self, goal_handle: Any) -> Fibonacci.Result:
        """Compute one sequence, then start the goal that has waited longest."""
        try:
            return super().execute_callback(goal_handle)
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


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    server.serve(MinimalActionServer, args)
