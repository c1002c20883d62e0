"""The states and transitions of a managed node, with the numbers and labels of ROS 2. Knows no node.

::

    unconfigured ──configure──▶ inactive ──activate──▶ active
         ▲  ◀──────cleanup──────   │  ◀───deactivate───  │
         │                         ▼                     ▼
    errorprocessing           shutdown (from any) ──▶ finalized
"""

from __future__ import annotations

import threading
from enum import IntEnum
from typing import NamedTuple

from rclpy._rclpy_pybind11 import RCLError

__all__ = ["LifecycleState", "StateMachine", "Transition", "TransitionCallbackReturn"]


class TransitionCallbackReturn(IntEnum):
    """What a transition's callback returns."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        """The label of the transition that follows."""
        return f"transition_{self.name.lower()}"


class LifecycleState(NamedTuple):
    """A state of a managed node."""

    label: str
    state_id: int


class Transition(NamedTuple):
    """A way from one state to another."""

    transition_id: int
    label: str
    start: LifecycleState
    goal: LifecycleState


_UNKNOWN = LifecycleState("unknown", 0)
_UNCONFIGURED = LifecycleState("unconfigured", 1)
_INACTIVE = LifecycleState("inactive", 2)
_ACTIVE = LifecycleState("active", 3)
_FINALIZED = LifecycleState("finalized", 4)
_CONFIGURING = LifecycleState("configuring", 10)
_CLEANING_UP = LifecycleState("cleaningup", 11)
_SHUTTING_DOWN = LifecycleState("shuttingdown", 12)
_ACTIVATING = LifecycleState("activating", 13)
_DEACTIVATING = LifecycleState("deactivating", 14)
_ERROR_PROCESSING = LifecycleState("errorprocessing", 15)

STATES = (
    _UNKNOWN,
    _UNCONFIGURED,
    _INACTIVE,
    _ACTIVE,
    _FINALIZED,
    _CONFIGURING,
    _CLEANING_UP,
    _SHUTTING_DOWN,
    _ACTIVATING,
    _DEACTIVATING,
    _ERROR_PROCESSING,
)


def _outcomes(first_id: int, during: LifecycleState, *goals: LifecycleState) -> list[Transition]:
    """The three ends of a transition: success, failure, error."""
    labels = [outcome.to_label() for outcome in TransitionCallbackReturn]
    return [Transition(first_id + index, labels[index], during, goal) for index, goal in enumerate(goals)]


TRANSITIONS = (
    Transition(1, "configure", _UNCONFIGURED, _CONFIGURING),
    *_outcomes(10, _CONFIGURING, _INACTIVE, _UNCONFIGURED, _ERROR_PROCESSING),
    Transition(2, "cleanup", _INACTIVE, _CLEANING_UP),
    *_outcomes(20, _CLEANING_UP, _UNCONFIGURED, _INACTIVE, _ERROR_PROCESSING),
    Transition(3, "activate", _INACTIVE, _ACTIVATING),
    *_outcomes(30, _ACTIVATING, _ACTIVE, _INACTIVE, _ERROR_PROCESSING),
    Transition(4, "deactivate", _ACTIVE, _DEACTIVATING),
    *_outcomes(40, _DEACTIVATING, _INACTIVE, _ACTIVE, _ERROR_PROCESSING),
    Transition(5, "shutdown", _UNCONFIGURED, _SHUTTING_DOWN),
    Transition(6, "shutdown", _INACTIVE, _SHUTTING_DOWN),
    Transition(7, "shutdown", _ACTIVE, _SHUTTING_DOWN),
    *_outcomes(50, _SHUTTING_DOWN, _FINALIZED, _FINALIZED, _ERROR_PROCESSING),
    *_outcomes(60, _ERROR_PROCESSING, _UNCONFIGURED, _FINALIZED, _FINALIZED),
)


class StateMachine:
    """The present state of one node. Thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._state = _UNCONFIGURED

    @property
    def current_state(self) -> LifecycleState:
        """Where the node is."""
        return self._state

    @property
    def available_states(self) -> tuple[LifecycleState, ...]:
        """All states."""
        return STATES

    @property
    def transition_graph(self) -> tuple[Transition, ...]:
        """All transitions."""
        return TRANSITIONS

    @property
    def available_transitions(self) -> list[Transition]:
        """The transitions that start here."""
        return [transition for transition in TRANSITIONS if transition.start == self._state]

    def trigger(self, which: int | str) -> Transition:
        """Go through a transition that starts here.

        Args:
            which: Its number or label.

        Returns:
            The transition.

        Raises:
            RCLError: None of that number or label starts here.
        """
        with self._lock:
            for transition in self.available_transitions:
                if which in (transition.transition_id, transition.label):
                    self._state = transition.goal
                    return transition
            state = self._state
        from rclpy.logging import get_logger

        known = ", ".join(f"{transition.label} ({transition.transition_id})" for transition in TRANSITIONS if transition.start == state)
        get_logger("rcl_lifecycle").warning(f"No transition matching {which} found for current state {state.label}")
        error = RCLError("Failed to trigger lifecycle state machine transition: Transition is not registered.")
        if hasattr(error, "add_note"):
            error.add_note(f"From {state.label} these lead on: {known or 'none'}.")
        raise error
