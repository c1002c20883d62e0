"""Emits an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.event import Event
from launch.utilities import ensure_argument_type

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class EmitEvent(Action):
    """Emits an event.

    Args:
        event: The event.
        **kwargs: See :class:`Action`.
    """

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        ensure_argument_type(event, [Event], "event", "EmitEvent")
        self._event = event

    @property
    def event(self) -> Event:
        """The event."""
        return self._event

    def execute(self, context: LaunchContext) -> None:
        context.emit_event_sync(self._event)
