"""Handles a change of the state of a managed node."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.event_handler import EventHandler
from launch_ros.events.lifecycle import StateTransition

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType
    from launch_ros.events.matchers.matches_node_name import NamedNode


class OnStateTransition(EventHandler):
    """Handles a change of the state of a managed node.

    Args:
        entities: What to visit then, or a function of event and context that returns it.
        target_lifecycle_node: The node; None for all.
        transition: Name of the transition; None for all.
        start_state: Name of the state before; None for all.
        goal_state: Name of the state after; None for all.
        **kwargs: See :class:`launch.EventHandler`.
    """

    def __init__(
        self,
        *,
        entities: SomeEntitiesType | Callable[[Any, LaunchContext], SomeEntitiesType | None],
        target_lifecycle_node: NamedNode | None = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        **kwargs: Any,
    ) -> None:
        self._wanted = {
            "action": target_lifecycle_node,
            "transition": transition,
            "start_state": start_state,
            "goal_state": goal_state,
        }
        super().__init__(matcher=self._is_wanted, entities=entities, **kwargs)

    def _is_wanted(self, event: Event) -> bool:
        if not isinstance(event, StateTransition):
            return False
        return all(
            wanted is None or getattr(event, name) == wanted
            for name, wanted in self._wanted.items()
        )

    @property
    def matcher_description(self) -> str:
        """Short description of the events."""
        return "event == StateTransition"
