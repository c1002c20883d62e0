"""An action client that cancels its goal after two seconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import rclpy
from examples_rclpy_minimal_action_client import client

if TYPE_CHECKING:
    from rclpy.task import Future


class MinimalActionClient(client.MinimalActionClient):
    """Asks for the Fibonacci sequence of order 10, and cancels the goal two seconds later."""

    def follow(self, goal_handle: Any) -> None:
        """Start the timer that cancels the goal."""
        self._goal_handle = goal_handle
        self._timer = self.create_timer(2.0, self.timer_callback)

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
    client.send(MinimalActionClient, args)
