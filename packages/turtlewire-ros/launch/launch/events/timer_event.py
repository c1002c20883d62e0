"""The time of a timer is over."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity


class TimerEvent(Event):
    """The time of a timer is over.

    Args:
        timer_action: The timer.
    """

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: LaunchDescriptionEntity) -> None:
        self._timer_action = timer_action

    @property
    def timer_action(self) -> LaunchDescriptionEntity:
        """The timer."""
        return self._timer_action
