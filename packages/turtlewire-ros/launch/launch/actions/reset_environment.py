"""Restores the environment variables that were there when the launch began."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext


@expose_action("reset_env")
class ResetEnvironment(Action):
    """Restores the environment variables that were there when the launch began."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ResetEnvironment], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        context.reset_environment()
