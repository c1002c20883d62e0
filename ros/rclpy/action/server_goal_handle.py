"""The goals of an action server; ``rclpy.action.server`` has the class under its public name."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from rclpy.task import Future

from .goal_state import ACTIVE_STATES, GoalEvent, next_state

if TYPE_CHECKING:
    from collections.abc import Callable

    from .server import ActionServer

__all__ = ["ServerGoalHandle"]


class ServerGoalHandle:
    """A goal that the server has accepted. Thread-safe."""

    def __init__(self, action_server: ActionServer, goal_info: Any, goal_request: Any) -> None:
        self._action_server = action_server
        self._goal_info = goal_info
        self._goal_request = goal_request
        self._status = 1
        self._lock = threading.Lock()
        self._finished_ns: int | None = None
        self._result = Future()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and self.goal_id == other.goal_id

    def __hash__(self) -> int:
        return hash(bytes(self.goal_id.uuid))

    @property
    def request(self) -> Any:
        """The goal, as the client sent it."""
        return self._goal_request

    @property
    def goal_id(self) -> Any:
        """Identifies the goal (``unique_identifier_msgs/msg/UUID``)."""
        return self._goal_info.goal_id

    @property
    def is_active(self) -> bool:
        """Whether it is not finished."""
        return self._status in ACTIVE_STATES

    @property
    def is_cancel_requested(self) -> bool:
        """Whether a client wants it cancelled, and the cancel callback agreed."""
        return self._status == 3

    @property
    def status(self) -> int:
        """A number of ``action_msgs/msg/GoalStatus``."""
        return self._status

    def execute(self, execute_callback: Callable[[ServerGoalHandle], Any] | None = None) -> None:
        """Have the goal executed by ``execute_callback``, or by that of the server."""
        if not self.is_cancel_requested:
            self._update_state(GoalEvent.EXECUTE)
        self._action_server.notify_execute(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Send feedback.

        Raises:
            TypeError: ``feedback`` is not a ``Feedback`` of the action.
        """
        self._action_server._publish_feedback(self.goal_id, feedback)

    def succeed(self) -> None:
        """The goal is reached; RCLError when it is finished already."""
        self._update_state(GoalEvent.SUCCEED)

    def abort(self) -> None:
        """The goal is given up; RCLError when it is finished already."""
        self._update_state(GoalEvent.ABORT)

    def canceled(self) -> None:
        """The goal is cancelled as a client wanted; RCLError when none did."""
        self._update_state(GoalEvent.CANCELED)

    def destroy(self) -> None:
        """Forget the goal."""
        self._action_server._forget(self)

    def _update_state(self, event: GoalEvent) -> None:
        with self._lock:
            self._status = next_state(self._status, event)
            if self._status not in ACTIVE_STATES:
                self._finished_ns = self._action_server._now_ns()
        self._action_server._publish_status()
        if not self.is_active:
            self._action_server.notify_goal_done()
