"""A request to change the state of managed nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar

from launch.event import Event

if TYPE_CHECKING:
    from launch_ros.events.matchers.matches_node_name import NamedNode

# The numbers of `lifecycle_msgs`, whose import would slow each launch; a test compares them.
_STATES = {
    0: "unknown",
    1: "unconfigured",
    2: "inactive",
    3: "active",
    4: "finalized",
    10: "configuring",
    11: "cleaningup",
    12: "shuttingdown",
    13: "activating",
    14: "deactivating",
    15: "errorprocessing",
}
_TRANSITIONS = {
    0: "create",
    1: "configure",
    2: "cleanup",
    3: "activate",
    4: "deactivate",
    5: "unconfigured_shutdown",
    6: "inactive_shutdown",
    7: "active_shutdown",
    8: "destroy",
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
    valid_states: ClassVar[dict[int, str]] = _STATES
    #: Names of the transitions by their numbers in ``lifecycle_msgs/msg/Transition``.
    valid_transitions: ClassVar[dict[int, str]] = _TRANSITIONS

    def __init__(
        self, *, lifecycle_node_matcher: Callable[[NamedNode], bool], transition_id: int
    ) -> None:
        self._matcher = lifecycle_node_matcher
        self._transition_id = transition_id

    @property
    def lifecycle_node_matcher(self) -> Callable[[NamedNode], bool]:
        """Matcher of the nodes."""
        return self._matcher

    @property
    def transition_id(self) -> int:
        """The transition."""
        return self._transition_id
