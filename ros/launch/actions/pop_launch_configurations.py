"""Restores the launch configurations that were remembered last."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["PopLaunchConfigurations"]


@expose_action("pop_launch_configurations")
class PopLaunchConfigurations(Action):
    """Restores the launch configurations that were remembered last."""

    def execute(self, context: LaunchContext) -> None:
        """Restore them."""
        context.configuration_scopes.pop()
