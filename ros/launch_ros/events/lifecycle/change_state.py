"""A request to change the state of managed nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch_ros.events.named_node import NamedNode

__all__ = ["ChangeState"]


class ChangeState(Event):
    """A request to change the state of managed nodes.

    Args:
        lifecycle_node_matcher: Which ones: a predicate over the actions that run them.
        transition_id: The transition, for example ``Transition.TRANSITION_CONFIGURE`` of
            ``lifecycle_msgs.msg``.
    """

    name = "launch_ros.events.lifecycle.ChangeState"

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
