"""Rotations that a page requests, sent as action goals."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.action import ActionClient
from turtlesim.action import RotateAbsolute

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.task import Future

__all__ = ["PageRotations"]


class PageRotations:
    """Clients of the action ``rotate_absolute``, one for each turtle that the page has turned.

    Not thread-safe: for the executor's thread.

    Args:
        node: The simulator's node, whose clients they are.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, ActionClient] = {}
        self._goals: dict[str, Future] = {}

    def rotate(self, turtle: str, theta: float) -> bool:
        """Send a goal; False if the client has not found the action yet: try again later."""
        client = self._clients.get(turtle)
        if client is None:
            client = self._clients[turtle] = ActionClient(
                self._node, RotateAbsolute, f"{turtle}/rotate_absolute"
            )
        if not client.server_is_ready():
            return False
        self._goals[turtle] = client.send_goal_async(RotateAbsolute.Goal(theta=theta))
        return True

    def cancel(self, turtle: str) -> None:
        """Cancel the last goal, if it was accepted; one that has ended stays as it is."""
        goal = self._goals.get(turtle)
        if goal is not None and goal.done() and goal.result().accepted:
            goal.result().cancel_goal_async()

    def forget(self, turtle: str) -> None:
        """Close the client of a turtle that is gone."""
        self._goals.pop(turtle, None)
        client = self._clients.pop(turtle, None)
        if client is not None:
            client.destroy()
