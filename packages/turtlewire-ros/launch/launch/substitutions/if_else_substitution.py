"""One of two texts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions.boolean_substitution import as_bool
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("if")
class IfElseSubstitution(Substitution):
    """Chooses one of two texts by a condition.

    Args:
        condition: A text that is true or false.
        if_value: The text when it is true.
        else_value: The text when it is false.
    """

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:
        if if_value == "" and else_value == "":
            raise RuntimeError("One of if_value and else_value must be specified")
        self._condition = normalize_to_list_of_substitutions(condition)
        self._if_value = normalize_to_list_of_substitutions(if_value)
        self._else_value = normalize_to_list_of_substitutions(else_value)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[IfElseSubstitution], dict[str, Any]]:
        """Read ``$(if condition if_value [else_value])``."""
        if not 2 <= len(data) <= 3:
            raise TypeError("if substitution expects 2 or 3 arguments")
        return cls, {
            "condition": data[0],
            "if_value": data[1],
            "else_value": data[2] if len(data) == 3 else "",
        }

    @property
    def condition(self) -> list[Substitution]:
        """The text that is true or false."""
        return self._condition

    @property
    def if_value(self) -> list[Substitution]:
        """The text when it is true."""
        return self._if_value

    @property
    def else_value(self) -> list[Substitution]:
        """The text when it is false."""
        return self._else_value

    def describe(self) -> str:
        parts = map(described, (self._condition, self._if_value, self._else_value))
        return f"IfElseSubstitution({', '.join(parts)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the chosen text."""
        return perform_substitutions(
            context, self._if_value if as_bool(context, self._condition) else self._else_value
        )
