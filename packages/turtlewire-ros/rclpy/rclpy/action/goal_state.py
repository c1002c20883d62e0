"""The states of a goal, and the events that change them."""

from __future__ import annotations

from enum import Enum

from rclpy._rclpy_pybind11 import RCLError

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


def state_name(state: int) -> str:
    """Return the name of a state, for example ``EXECUTING``."""
    return _NAMES[state]


def next_state(state: int, event: GoalEvent) -> int:
    """Return the state that ``event`` leads to.

    Raises:
        RCLError: The event is not possible in this state.
    """
    following = _TRANSITIONS.get((state, event))
    if following is None:
        raise RCLError(
            "Failed to update goal state: goal_handle attempted invalid transition from state "
            f"{state_name(state)} with event {event.name}"
        )
    return following
