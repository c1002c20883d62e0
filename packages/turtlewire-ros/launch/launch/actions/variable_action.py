"""The common parts of actions that set, extend, unset, remember and restore variables.

The variables of a launch are its environment variables and its launch configurations.
"""

from __future__ import annotations

from collections.abc import MutableMapping
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


class ScopeAction(Action):
    """Base of the actions that remember all variables, and put them back."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ScopeAction], dict[str, Any]]:
        """Read what all actions have."""
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs


class VariableAction(Action):
    """Base of the actions that change one named text.

    Args:
        name: Its name.
        **kwargs: See :class:`Action`.
    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[VariableAction], dict[str, Any]]:
        """Read the attribute ``name``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable."""
        return self._name

    def variables(self, context: LaunchContext) -> MutableMapping[str, str]:
        """Return the mapping that the action changes."""
        raise NotImplementedError(f"{type(self).__name__} does not define variables()")


class SetVariableAction(VariableAction):
    """Base of the actions that set a named text.

    Args:
        name: Its name.
        value: Its value.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(name, **kwargs)
        self._value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[SetVariableAction], dict[str, Any]]:
        """Read the attributes ``name`` and ``value``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    @property
    def value(self) -> list[Substitution]:
        """The value of the variable."""
        return self._value

    def execute(self, context: LaunchContext) -> None:
        name = perform_substitutions(context, self._name)
        self.variables(context)[name] = perform_substitutions(context, self._value)


class UnsetVariableAction(VariableAction):
    """Base of the actions that remove a named text, if there is one."""

    def execute(self, context: LaunchContext) -> None:
        self.variables(context).pop(perform_substitutions(context, self._name), None)
