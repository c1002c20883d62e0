"""Forgets a launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["UnsetLaunchConfiguration"]


@expose_action("unset")
class UnsetLaunchConfiguration(Action):
    """Forgets a launch configuration.

    Args:
        name: Its name.
        **kwargs: See :class:`Action`.
    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[UnsetLaunchConfiguration], dict[str, Any]]:
        """Read an ``unset`` element."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """Its name."""
        return self._name

    def execute(self, context: LaunchContext) -> None:
        """Forget it, if it is set."""
        context.launch_configurations.pop(perform_substitutions(context, self._name), None)
