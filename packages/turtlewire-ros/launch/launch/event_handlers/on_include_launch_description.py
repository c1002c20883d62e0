"""Handles the inclusion of a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from launch.event_handler import EventHandler
from launch.events import IncludeLaunchDescription

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnIncludeLaunchDescription(EventHandler):
    """Returns the included description, which is then visited.

    Args:
        **kwargs: See :class:`BaseEventHandler`.
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(
            matcher=lambda event: isinstance(event, IncludeLaunchDescription), **kwargs
        )

    @property
    def matcher_description(self) -> str:
        """Short description of the events."""
        return "event is IncludeLaunchDescription"

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        super().handle(event, context)
        return [cast("IncludeLaunchDescription", event).launch_description]
