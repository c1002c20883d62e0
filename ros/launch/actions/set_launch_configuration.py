"""Sets a launch configuration."""

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

__all__ = ["SetLaunchConfiguration"]


@expose_action("let")
class SetLaunchConfiguration(Action):
    """Sets a launch configuration.

    Args:
        name: Its name.
        value: Its value.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self._name = normalize_to_list_of_substitutions(name)
        self._value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[SetLaunchConfiguration], dict[str, Any]]:
        """Read a ``let`` element."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """Its name."""
        return self._name

    @property
    def value(self) -> list[Substitution]:
        """Its value."""
        return self._value

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        context.launch_configurations[perform_substitutions(context, self._name)] = (
            perform_substitutions(context, self._value)
        )
