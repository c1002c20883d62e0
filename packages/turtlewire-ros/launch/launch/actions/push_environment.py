"""Remembers the environment variables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.actions.variable_action import ScopeAction
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("push_env")
class PushEnvironment(ScopeAction):
    """Remembers the environment variables."""

    def execute(self, context: LaunchContext) -> None:
        context.environment_scopes.push()
