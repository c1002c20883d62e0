"""Restores the environment variables that were there when the launch began."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.actions.variable_action import ScopeAction
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("reset_env")
class ResetEnvironment(ScopeAction):
    """Restores the environment variables that were there when the launch began."""

    def execute(self, context: LaunchContext) -> None:
        context.reset_environment()
