"""Restores the launch configurations that were remembered last."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext


@expose_action("pop_launch_configurations")
class PopLaunchConfigurations(Action):
    """Restores the launch configurations that were remembered last."""

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[PopLaunchConfigurations], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        context.configuration_scopes.pop()
