"""Extends an environment variable that is a list."""

from __future__ import annotations

import os
from collections.abc import MutableMapping
from typing import TYPE_CHECKING, Any

from launch.actions.variable_action import SetVariableAction
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import coerce_to_type

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("append_env")
class AppendEnvironmentVariable(SetVariableAction):
    """Adds a value to a list in an environment variable such as ``PATH``, or sets the variable.

    Args:
        name: Its name.
        value: The value.
        prepend: Add it before the others: true or false, or text that YAML or a condition reads as
            that (``yes``, ``1``).
        separator: What stands between values.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(name, value, **kwargs)
        self._prepend = normalize_to_list_of_substitutions(
            str(prepend) if isinstance(prepend, bool) else prepend
        )
        self._separator = normalize_to_list_of_substitutions(separator)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[AppendEnvironmentVariable], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        prepend = entity.get_attr("prepend", optional=True, data_type=bool, can_be_str=True)
        if prepend is not None:
            kwargs["prepend"] = parser.parse_if_substitutions(prepend)
        separator = entity.get_attr("separator", optional=True)
        if separator is not None:
            kwargs["separator"] = parser.parse_substitution(separator)
        return cls, kwargs

    @property
    def prepend(self) -> list[Substitution]:
        """True or false as text: the value comes before the others."""
        return self._prepend

    @property
    def separator(self) -> list[Substitution]:
        """Separator between values."""
        return self._separator

    def variables(self, context: LaunchContext) -> MutableMapping[str, str]:
        """Return the environment of this process, which its children inherit."""
        return context.environment

    def execute(self, context: LaunchContext) -> None:
        name = perform_substitutions(context, self._name)
        value = perform_substitutions(context, self._value)
        variables = self.variables(context)
        if name in variables:
            parts = [variables[name], value]
            prepend = perform_substitutions(context, self._prepend)
            if coerce_to_type({"0": "false", "1": "true"}.get(prepend, prepend), bool):
                parts.reverse()
            value = perform_substitutions(context, self._separator).join(parts)
        variables[name] = value
