"""Remembers the launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext


@expose_action("push_launch_configurations")
class PushLaunchConfigurations(Action):
    """Remembers the launch configurations."""

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[PushLaunchConfigurations], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        context.configuration_scopes.push()
