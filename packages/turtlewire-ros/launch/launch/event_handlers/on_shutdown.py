"""Handles the end of the launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.event_handler import EventHandler
from launch.events import Shutdown

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


def gen_handler(entities: SomeEntitiesType) -> Callable[[Event, LaunchContext], SomeEntitiesType]:
    """Return a function of event and context that returns fixed entities."""
    return lambda _event, _context: entities


class OnShutdown(EventHandler):
    """Handles the end of the launch.

    Args:
        on_shutdown: What to visit then, or a function of event and context that returns it.
        **kwargs: See :class:`BaseEventHandler`.
    """

    def __init__(
        self,
        *,
        on_shutdown: SomeEntitiesType | Callable[[Any, LaunchContext], SomeEntitiesType | None],
        **kwargs: Any,
    ) -> None:
        super().__init__(
            matcher=lambda event: isinstance(event, Shutdown), entities=on_shutdown, **kwargs
        )

    @property
    def matcher_description(self) -> str:
        """Short description of the events."""
        return "event is Shutdown"
