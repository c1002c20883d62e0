"""Remembers the launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.actions.variable_action import ScopeAction
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("push_launch_configurations")
class PushLaunchConfigurations(ScopeAction):
    """Remembers the launch configurations."""

    def execute(self, context: LaunchContext) -> None:
        context.configuration_scopes.push()
