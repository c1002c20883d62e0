"""The states of a managed node and its transitions, with the numbers of lifecycle_msgs."""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from rclpy._rclpy_pybind11 import RCLError


class TransitionCallbackReturn(Enum):
    """The result of a transition callback."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        """Return the label, for example ``transition_success``."""
        return f"transition_{self.name.lower()}"


class LifecycleState(NamedTuple):
    """A state."""

    label: str
    state_id: int


class Transition(NamedTuple):
    """A transition from one state to another."""

    transition_id: int
    label: str
    start: LifecycleState
    goal: LifecycleState


STATES = {
    number: LifecycleState(label, number)
    for number, label in (
        (0, "unknown"),
        (1, "unconfigured"),
        (2, "inactive"),
        (3, "active"),
        (4, "finalized"),
        (10, "configuring"),
        (11, "cleaningup"),
        (12, "shuttingdown"),
        (13, "activating"),
        (14, "deactivating"),
        (15, "errorprocessing"),
    )
}

_UNCONFIGURED, _INACTIVE, _ACTIVE, _FINALIZED = 1, 2, 3, 4
_CONFIGURING, _CLEANING_UP, _SHUTTING_DOWN, _ACTIVATING, _DEACTIVATING, _ERROR_PROCESSING = (
    10,
    11,
    12,
    13,
    14,
    15,
)

_REQUESTED = (
    (1, "configure", _UNCONFIGURED, _CONFIGURING),
    (2, "cleanup", _INACTIVE, _CLEANING_UP),
    (3, "activate", _INACTIVE, _ACTIVATING),
    (4, "deactivate", _ACTIVE, _DEACTIVATING),
    (5, "shutdown", _UNCONFIGURED, _SHUTTING_DOWN),
    (6, "shutdown", _INACTIVE, _SHUTTING_DOWN),
    (7, "shutdown", _ACTIVE, _SHUTTING_DOWN),
)
#: State in which a callback runs, number of its success, and the states after success, failure and
#: error.
_REPORTED = (
    (_CONFIGURING, 10, _INACTIVE, _UNCONFIGURED, _ERROR_PROCESSING),
    (_CLEANING_UP, 20, _UNCONFIGURED, _INACTIVE, _ERROR_PROCESSING),
    (_ACTIVATING, 30, _ACTIVE, _INACTIVE, _ERROR_PROCESSING),
    (_DEACTIVATING, 40, _INACTIVE, _ACTIVE, _ERROR_PROCESSING),
    (_SHUTTING_DOWN, 50, _FINALIZED, _FINALIZED, _ERROR_PROCESSING),
    (_ERROR_PROCESSING, 60, _UNCONFIGURED, _FINALIZED, _FINALIZED),
)


def _all_transitions() -> list[Transition]:
    """Return all transitions in ROS 2's order: first into a state, then out of it."""
    transitions: list[Transition] = []
    for start, first, *goals in _REPORTED:
        transitions += [
            Transition(number, label, STATES[origin], STATES[start])
            for number, label, origin, goal in _REQUESTED
            if goal == start
        ]
        for offset, (outcome, goal) in enumerate(zip(TransitionCallbackReturn, goals, strict=True)):
            transitions.append(
                Transition(first + offset, outcome.to_label(), STATES[start], STATES[goal])
            )
    return transitions


TRANSITIONS = _all_transitions()


class StateMachine:
    """The state of a node and its possible transitions."""

    def __init__(self) -> None:
        self.current_state = STATES[_UNCONFIGURED]

    @property
    def available_transitions(self) -> list[Transition]:
        """The transitions from the current state."""
        return [transition for transition in TRANSITIONS if transition.start == self.current_state]

    def by_label(self, label: str) -> Transition:
        """Return the transition with this label.

        Raises:
            RCLError: The state has no transition with this label.
        """
        return self._find(
            label,
            [transition for transition in self.available_transitions if transition.label == label],
        )

    def by_id(self, transition_id: int) -> Transition:
        """Return the transition with this number; raises as :meth:`by_label`."""
        ways = [
            transition
            for transition in self.available_transitions
            if transition.transition_id == transition_id
        ]
        return self._find(str(transition_id), ways)

    def _find(self, wanted: str, found: list[Transition]) -> Transition:
        if not found:
            possible = ", ".join(
                f"{transition.label} ({transition.transition_id})"
                for transition in self.available_transitions
            )
            raise RCLError(
                "Failed to trigger lifecycle state machine transition: no transition matching "
                f"{wanted} found for current state "
                f"{self.current_state.label}; possible transitions: {possible or 'none'}"
            )
        return found[0]
