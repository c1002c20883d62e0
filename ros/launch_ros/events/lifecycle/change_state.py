"""A request to change the state of managed nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from launch.event import Event

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch_ros.events.named_node import NamedNode

__all__ = ["ChangeState"]


def _names(message: str, *prefixes: str) -> dict[int, str]:
    """Names of a message's constants with one of the prefixes, by their values."""
    from lifecycle_msgs import msg

    kind: Any = getattr(msg, message)
    constants = {name: getattr(kind, name) for name in dir(kind) if name.startswith(prefixes)}
    return {
        value: next(name.removeprefix(each) for each in prefixes if name.startswith(each)).lower()
        for name, value in constants.items()
    }


class ChangeState(Event):
    """A request to change the state of managed nodes.

    Args:
        lifecycle_node_matcher: Which ones: a predicate over the actions that run them.
        transition_id: The transition, for example ``Transition.TRANSITION_CONFIGURE`` of
            ``lifecycle_msgs.msg``.
    """

    name = "launch_ros.events.lifecycle.ChangeState"

    #: Names of the states by their numbers in ``lifecycle_msgs/msg/State``.
    valid_states: ClassVar[dict[int, str]] = _names("State", "PRIMARY_STATE_", "TRANSITION_STATE_")
    #: Names of the transitions by their numbers in ``lifecycle_msgs/msg/Transition``.
    valid_transitions: ClassVar[dict[int, str]] = _names("Transition", "TRANSITION_")

    def __init__(
        self, *, lifecycle_node_matcher: Callable[[NamedNode], bool], transition_id: int
    ) -> None:
        self._matcher = lifecycle_node_matcher
        self._transition_id = transition_id

    @property
    def lifecycle_node_matcher(self) -> Callable[[NamedNode], bool]:
        """Which nodes."""
        return self._matcher

    @property
    def transition_id(self) -> int:
        """The transition."""
        return self._transition_id
