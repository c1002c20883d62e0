"""A managed node has changed its state."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event import Event

if TYPE_CHECKING:
    from launch_ros.events.matchers.matches_node_name import NamedNode


class StateTransition(Event):
    """A managed node has changed its state.

    Args:
        action: The action that runs it.
        msg: The message of the node, a ``lifecycle_msgs/msg/TransitionEvent``.
    """

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: NamedNode, msg: Any) -> None:
        self._action = action
        self._msg = msg

    @property
    def action(self) -> NamedNode:
        """The action that runs the node."""
        return self._action

    @property
    def msg(self) -> Any:
        """Transition event of the node."""
        return self._msg

    @property
    def timestamp(self) -> int:
        """Time of the transition in nanoseconds, until Kilted."""
        return int(self._msg.timestamp)

    @property
    def stamp(self) -> Any:
        """Time of the transition (``builtin_interfaces/msg/Time``), in Lyrical."""
        return self._msg.stamp

    @property
    def transition(self) -> str:
        """Name of the transition, for example ``configure``."""
        return str(self._msg.transition.label)

    @property
    def start_state(self) -> str:
        """Name of the state before, for example ``unconfigured``."""
        return str(self._msg.start_state.label)

    @property
    def goal_state(self) -> str:
        """Name of the state after, for example ``configuring``."""
        return str(self._msg.goal_state.label)
