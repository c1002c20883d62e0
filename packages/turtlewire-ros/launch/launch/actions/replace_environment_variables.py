"""Replaces all environment variables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("rep_env")
class ReplaceEnvironmentVariables(Action):
    """Replaces all environment variables of the launch.

    Args:
        environment: Names and values of the variables that are there afterwards.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        environment: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._environment = [
            (normalize_to_list_of_substitutions(name), normalize_to_list_of_substitutions(value))
            for name, value in (environment or {}).items()
        ]

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[ReplaceEnvironmentVariables], dict[str, Any]]:
        """Read a ``rep_env`` element with ``env`` children."""
        _, kwargs = super().parse(entity, parser)
        variables = entity.get_attr("env", data_type=list[Entity], optional=True) or []
        kwargs["environment"] = {
            tuple(parser.parse_substitution(each.get_attr("name"))): parser.parse_substitution(
                each.get_attr("value")
            )
            for each in variables
        }
        for each in variables:
            each.assert_entity_completely_parsed()
        return cls, kwargs

    @property
    def environment(self) -> list[tuple[list[Substitution], list[Substitution]]]:
        """Names and values."""
        return self._environment

    def execute(self, context: LaunchContext) -> None:
        variables = {
            perform_substitutions(context, name): perform_substitutions(context, value)
            for name, value in self._environment
        }
        context.environment_scopes.replace(variables)
