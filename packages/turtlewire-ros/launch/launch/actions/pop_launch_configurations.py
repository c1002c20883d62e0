"""Restores the launch configurations that were remembered last."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.actions.variable_action import ScopeAction
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("pop_launch_configurations")
class PopLaunchConfigurations(ScopeAction):
    """Restores the launch configurations that were remembered last."""

    def execute(self, context: LaunchContext) -> None:
        context.configuration_scopes.pop()
