"""Reactions to events."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class BaseEventHandler:
    """Decides which events it handles, and returns the entities to visit then.

    Args:
        matcher: Whether to handle an event.
        handle_once: Unregister after the first event.
    """

    def __init__(self, *, matcher: Callable[[Event], bool], handle_once: bool = False) -> None:
        self._matcher = matcher
        self._handle_once = handle_once

    @property
    def handle_once(self) -> bool:
        """True if it handles only one event."""
        return self._handle_once

    @property
    def handler_description(self) -> str:
        """Short description of the handler."""
        return "{OMITTED}"

    @property
    def matcher_description(self) -> str:
        """Short description of the events."""
        return "{OMITTED}"

    def matches(self, event: Event) -> bool:
        """Return True if it handles the event."""
        return self._matcher(event)

    def describe(self) -> tuple[str, list[Any]]:
        """Return a text, and the entities that the handler returns, as far as they are known."""
        text = (
            f"{type(self).__name__}(matcher='{self.matcher_description}', "
            f"handler='{self.handler_description}', handle_once={self._handle_once})"
        )
        return text, []

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """React to the event; the returned entities are visited."""
        context.extend_locals({"event": event})
        # Before the entities are visited, which may cause the next event.
        if self._handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """Returns fixed entities, or what a function of event and context returns.

    Args:
        matcher: Whether to handle an event.
        entities: What to visit then, or a function that returns it.
        handle_once: Unregister after the first event.
    """

    def __init__(
        self,
        *,
        matcher: Callable[[Event], bool],
        entities: SomeEntitiesType
        | Callable[[Event, LaunchContext], SomeEntitiesType | None]
        | None = None,
        handle_once: bool = False,
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self._function = entities if callable(entities) else None
        self._entities = [] if entities is None or callable(entities) else entity_list(entities)

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """The fixed entities."""
        return self._entities

    @property
    def handler_description(self) -> str:
        """The function's name, or that actions are returned."""
        return "<actions>" if self._function is None else str(self._function)

    def describe(self) -> tuple[str, list[Any]]:
        return super().describe()[0], list(self._entities)

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        super().handle(event, context)
        return self._entities if self._function is None else self._function(event, context)


def entity_list(entities: SomeEntitiesType) -> list[LaunchDescriptionEntity]:
    """Return one entity or several as a list."""
    if isinstance(entities, LaunchDescriptionEntity):
        return [entities]
    items: Iterable[LaunchDescriptionEntity] = entities
    return list(items)
