"""The goals of an action server; ``rclpy.action.server`` has the class under its public name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .goal_state import GoalEvent

if TYPE_CHECKING:
    from collections.abc import Callable

    from ._goals import Goal, Goals
    from .server import ActionServer

__all__ = ["ServerGoalHandle"]


class ServerGoalHandle:
    """A goal that the server has accepted. Thread-safe."""

    def __init__(self, action_server: ActionServer, goal: Goal, goals: Goals) -> None:
        self._action_server = action_server
        self._goal = goal
        self._goals = goals

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and self.goal_id == other.goal_id

    def __hash__(self) -> int:
        return hash(self._goal.key)

    @property
    def request(self) -> Any:
        """The goal, as the client sent it."""
        return self._goal.request

    @property
    def goal_id(self) -> Any:
        """Identifies the goal (``unique_identifier_msgs/msg/UUID``)."""
        return self._goal.info.goal_id

    @property
    def is_active(self) -> bool:
        """True if it is not finished."""
        return self._goal.is_active

    @property
    def is_cancel_requested(self) -> bool:
        """True if a client wants it cancelled, and the cancel callback agreed."""
        return self._goal.status == 3

    @property
    def status(self) -> int:
        """A number of ``action_msgs/msg/GoalStatus``."""
        return self._goal.status

    def execute(self, execute_callback: Callable[[ServerGoalHandle], Any] | None = None) -> None:
        """Execute the goal with ``execute_callback``, or with the server's callback."""
        if not self.is_cancel_requested:
            self._goals.advance(self._goal, GoalEvent.EXECUTE)
        self._action_server.notify_execute(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Send feedback.

        Raises:
            TypeError: ``feedback`` is not a ``Feedback`` of the action.
        """
        self._goals.publish_feedback(self._goal, feedback)

    def succeed(self) -> None:
        """The goal is reached; RCLError when it is finished already."""
        self._finish(GoalEvent.SUCCEED)

    def abort(self) -> None:
        """The goal is given up; RCLError when it is finished already."""
        self._finish(GoalEvent.ABORT)

    def canceled(self) -> None:
        """The goal is cancelled as a client wanted; RCLError when none did."""
        self._finish(GoalEvent.CANCELED)

    def destroy(self) -> None:
        """Forget the goal."""
        self._goals.forget(self._goal.key)

    def _finish(self, event: GoalEvent) -> None:
        self._goals.advance(self._goal, event)
        self._action_server.notify_goal_done()
