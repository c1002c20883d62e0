"""The goals of an action server; ``rclpy.action.server`` has the class under its public name."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import RCLError
from turtlewire.distro import LYRICAL, since

from ._goals import Goal, GoalEvent

if TYPE_CHECKING:
    from .server import ActionServer

_EXECUTING = 2
_IGNORED_FEEDBACK = "publish_feedback() called on a goal handle not in executing state, ignoring"


class ServerGoalHandle:
    """A goal that the server has accepted. Thread-safe.

    A new handle adds its goal to the goals of the server.

    Args:
        action_server: The server of the goal.
        goal_info: Its id and the time of its acceptance (``action_msgs/msg/GoalInfo``).
        goal_request: The goal, as the client sent it.

    Raises:
        RCLError: The server has a goal with this id.
    """

    def __init__(self, action_server: ActionServer, goal_info: Any, goal_request: Any) -> None:
        self._action_server = action_server
        self._goal = Goal(goal_info, goal_request)
        self._goals = action_server._goals
        self._goals.add(self._goal, self)

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
        return self._goal.status == 3  # CANCELING

    @property
    def status(self) -> int:
        """A number of ``action_msgs/msg/GoalStatus``."""
        return self._goal.status

    def execute(self, execute_callback: Callable[[ServerGoalHandle], Any] | None = None) -> None:
        """Execute the goal with ``execute_callback``, or with the server's callback."""
        # As in ROS 2, a goal that was cancelled before its execution is still executed, so
        # that the callback can end it, but it cannot go back to EXECUTING.
        try:
            self._goals.advance(self._goal, GoalEvent.EXECUTE)
        except RCLError:
            if not self.is_cancel_requested:
                raise
        self._action_server.notify_execute(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Send feedback; in Lyrical, only while the goal is executed.

        Raises:
            TypeError: ``feedback`` is not a ``Feedback`` of the action.
        """
        if since(LYRICAL) and self._goal.status != _EXECUTING:
            self._action_server._logger.warning(_IGNORED_FEEDBACK)
            return
        self._goals.publish_feedback(self._goal, feedback)

    def executing(self) -> None:
        """Mark a goal as executed by the program itself; once it is, this does nothing."""
        if self._goal.status != _EXECUTING:
            self._goals.advance(self._goal, GoalEvent.EXECUTE)

    def succeed(self, response: Any = None) -> None:
        """Mark the goal as succeeded; raise RCLError if it is finished already.

        Args:
            response: The result, from a server without an execute callback.
        """
        self._finish(GoalEvent.SUCCEED, response)

    def abort(self, response: Any = None) -> None:
        """Mark the goal as aborted, as `succeed` does; raise RCLError if it is finished already."""
        self._finish(GoalEvent.ABORT, response)

    def canceled(self, response: Any = None) -> None:
        """Mark the goal as cancelled, as `succeed` does; raise RCLError if no client wanted it."""
        self._finish(GoalEvent.CANCELED, response)

    def destroy(self) -> None:
        """Forget the goal."""
        self._goals.forget(self._goal.key)

    def _finish(self, event: GoalEvent, result: Any) -> None:
        self._goals.advance(self._goal, event)
        if result is not None:
            self._action_server._send_goal_result(self._goal, result)
        self._action_server.notify_goal_done()
