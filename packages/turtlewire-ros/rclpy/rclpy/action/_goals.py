"""The goals that an action server has accepted, until their results expire, and their states."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from enum import Enum
from heapq import heappop, heappush
from typing import Any

from rclpy._rclpy_pybind11 import RCLError
from rclpy.task import Future

from ._goal_statuses import GoalStatuses, goal_key

# the numbers of action_msgs/msg/GoalStatus
_ACCEPTED, _EXECUTING, _CANCELING, _SUCCEEDED, _CANCELED, _ABORTED = 1, 2, 3, 4, 5, 6
_NAMES = ("UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")

#: The states of an unfinished goal.
ACTIVE_STATES = frozenset({_ACCEPTED, _EXECUTING, _CANCELING})


class GoalEvent(Enum):
    """Events in the life of a goal."""

    EXECUTE = 1
    CANCEL_GOAL = 2
    SUCCEED = 3
    ABORT = 4
    CANCELED = 5


_TRANSITIONS = {
    (_ACCEPTED, GoalEvent.EXECUTE): _EXECUTING,
    (_ACCEPTED, GoalEvent.CANCEL_GOAL): _CANCELING,
    (_EXECUTING, GoalEvent.CANCEL_GOAL): _CANCELING,
    (_EXECUTING, GoalEvent.SUCCEED): _SUCCEEDED,
    (_EXECUTING, GoalEvent.ABORT): _ABORTED,
    (_CANCELING, GoalEvent.SUCCEED): _SUCCEEDED,
    (_CANCELING, GoalEvent.ABORT): _ABORTED,
    (_CANCELING, GoalEvent.CANCELED): _CANCELED,
}


def next_state(state: int, event: GoalEvent) -> int:
    """Return the state that ``event`` leads to.

    Raises:
        RCLError: The event is not possible in this state.
    """
    following = _TRANSITIONS.get((state, event))
    if following is None:
        raise RCLError(
            "Failed to update goal state: goal_handle attempted invalid transition from state "
            f"{_NAMES[state]} with event {event.name}"
        )
    return following


class Goal:
    """A goal, its state and, one day, its result.

    Attributes:
        info: Its id and the time of its acceptance (``action_msgs/msg/GoalInfo``).
        request: The goal, as the client sent it.
        key: The bytes of its id.
        status: A number of ``action_msgs/msg/GoalStatus``; only :class:`Goals` changes it.
        cancel_requested: Done when a client wants the goal cancelled and the server agreed.
        result: Of the response with its result.
    """

    def __init__(self, info: Any, request: Any) -> None:
        self.info = info
        self.request = request
        self.key = goal_key(info.goal_id)
        self.status = _ACCEPTED
        self.cancel_requested: Future[None] = Future()
        self.result: Future[Any] = Future()

    @property
    def is_active(self) -> bool:
        """True if it is not finished."""
        return self.status in ACTIVE_STATES


class Goals:
    """The goals of one server. Thread-safe.

    Args:
        publish_statuses: Is given the states of all goals, serialized, in the order of the changes.
        publish_feedback: Is given a goal and its feedback.
        now_ns: The time of the server's node.
    """

    def __init__(
        self,
        publish_statuses: Callable[[bytes], None],
        publish_feedback: Callable[[Goal, Any], None],
        now_ns: Callable[[], int],
    ) -> None:
        self.publish_feedback = publish_feedback
        self._publish = publish_statuses
        self._now_ns = now_ns
        self._lock = threading.Lock()
        self._goals: dict[bytes, Goal] = {}
        self._handles: dict[bytes, Any] = {}
        self._statuses = GoalStatuses()
        self._finished: list[tuple[int, bytes]] = []

    def __len__(self) -> int:
        return len(self._goals)

    def add(self, goal: Goal, handle: Any) -> None:
        """Keep a goal, and what the callbacks of the server are given for it.

        Raises:
            RCLError: Another goal has its id.
        """
        stamp = goal.info.stamp
        with self._lock:
            if goal.key in self._goals:
                raise RCLError("Failed to accept new goal: goal ID already exists")
            self._goals[goal.key] = goal
            self._handles[goal.key] = handle
            self._statuses.add(goal.key, stamp.sec, stamp.nanosec, goal.status)

    def find(self, key: bytes) -> Goal | None:
        """Return the goal with this id, unless it is unknown or has expired."""
        return self._goals.get(key)

    def all(self) -> list[tuple[Goal, Any]]:
        """Return all goals with their handles."""
        with self._lock:
            return [(goal, self._handles[key]) for key, goal in self._goals.items()]

    def to_cancel(self, wanted: Any, codes: Any) -> tuple[list[tuple[Goal, Any]], int]:
        """Return the active goals that a cancel request means, with their handles, and a code.

        No id and no stamp mean all goals, a stamp all that were accepted until then, an id that
        goal; both are joined.

        Args:
            wanted: The request's ``action_msgs/msg/GoalInfo``.
            codes: Has the return codes: the class or an object of the response.
        """
        key = goal_key(wanted.goal_id)
        stamp = (wanted.stamp.sec, wanted.stamp.nanosec)
        goals = self.all()
        if any(key) and stamp == (0, 0):
            named = [pair for pair in goals if pair[0].key == key]
            if not named:
                return [], codes.ERROR_UNKNOWN_GOAL_ID
            if not named[0][0].is_active:
                return [], codes.ERROR_GOAL_TERMINATED
            return named, codes.ERROR_NONE
        found = []
        for goal, handle in goals:
            accepted = (goal.info.stamp.sec, goal.info.stamp.nanosec)
            if goal.is_active and (stamp == (0, 0) or accepted <= stamp or goal.key == key):
                found.append((goal, handle))
        return found, codes.ERROR_NONE

    def publish_statuses(self) -> None:
        """Publish the states of all goals."""
        with self._lock:  # the publications come in the order of the changes
            self._publish(self._statuses.cdr())

    def advance(self, goal: Goal, event: GoalEvent) -> None:
        """Change the state of a goal, and publish it.

        Raises:
            RCLError: The event is not possible in its state.
        """
        with self._lock:
            goal.status = next_state(goal.status, event)
            self._statuses.change(goal.key, goal.status)
            if not goal.is_active and goal.key in self._goals:
                heappush(self._finished, (self._now_ns(), goal.key))
            self._publish(self._statuses.cdr())
        if event is GoalEvent.CANCEL_GOAL:
            goal.cancel_requested.set_result(None)

    def first_end_ns(self) -> int | None:
        """Return the time at which the first finished goal ended; None without one."""
        with self._lock:
            return self._finished[0][0] if self._finished else None

    def forget_those_finished_by(self, limit_ns: int) -> None:
        """Forget the goals that ended then or before."""
        with self._lock:
            expired = []
            while self._finished and self._finished[0][0] <= limit_ns:
                expired.append(heappop(self._finished)[1])
            self._forget(expired)

    def forget(self, key: bytes) -> None:
        """Forget a goal, finished or not."""
        with self._lock:
            self._finished = [end for end in self._finished if end[1] != key]
            self._forget([key])

    def _forget(self, keys: Iterable[bytes]) -> None:
        for key in keys:
            self._goals.pop(key, None)
            self._handles.pop(key, None)
        self._statuses.remove(keys)
