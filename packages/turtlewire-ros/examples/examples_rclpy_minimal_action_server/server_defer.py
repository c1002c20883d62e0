"""An action server that accepts a goal at once and executes it three seconds later."""

from __future__ import annotations

from typing import Any

from examples_rclpy_minimal_action_server import server


class MinimalActionServer(server.MinimalActionServer):
    """Computes Fibonacci sequences, each three seconds after its goal was accepted."""

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """Start the timer that executes the goal, instead of executing it here."""
        self.get_logger().info("Deferring execution...")

        def execute() -> None:
            # A timer repeats, but this goal is executed once.
            self.destroy_timer(timer)
            goal_handle.execute()

        timer = self.create_timer(3.0, execute)


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    server.serve(MinimalActionServer, args)
