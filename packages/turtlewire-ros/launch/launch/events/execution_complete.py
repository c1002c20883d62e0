"""An action has completed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity


class ExecutionComplete(Event):
    """An action has completed.

    Args:
        action: The action.
    """

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: LaunchDescriptionEntity) -> None:
        self._action = action

    @property
    def action(self) -> LaunchDescriptionEntity:
        """The action."""
        return self._action
