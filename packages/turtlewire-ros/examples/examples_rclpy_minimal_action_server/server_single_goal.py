"""An action server with one goal at a time: a new goal aborts the running one."""

from __future__ import annotations

from threading import Lock
from typing import Any

from examples_rclpy_minimal_action_server import server


class MinimalActionServer(server.MinimalActionServer):
    """Computes one Fibonacci sequence at a time, that of the latest goal."""

    def __init__(self) -> None:
        super().__init__()
        self._goal_handle: Any = None
        self._goal_lock = Lock()

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """Abort the running goal, if any, and execute the new one."""
        with self._goal_lock:
            if self._goal_handle is not None and self._goal_handle.is_active:
                self.get_logger().info("Aborting previous goal")
                self._goal_handle.abort()
            self._goal_handle = goal_handle
        goal_handle.execute()

    def is_stopped(self, goal_handle: Any) -> bool:
        """Return True if a new goal or a client has stopped this one; the lock keeps them apart."""
        with self._goal_lock:
            return self._is_aborted(goal_handle) or super().is_stopped(goal_handle)

    def succeed(self, goal_handle: Any) -> bool:
        """Let the goal succeed, unless a new one has aborted it during the last sleep."""
        with self._goal_lock:
            return not self._is_aborted(goal_handle) and super().succeed(goal_handle)

    def _is_aborted(self, goal_handle: Any) -> bool:
        if goal_handle.is_active:
            return False
        self.get_logger().info("Goal aborted")
        return True


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    server.serve(MinimalActionServer, args)
