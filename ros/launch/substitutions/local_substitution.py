"""A value that belongs to the present event."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["LocalSubstitution"]


class LocalSubstitution(Substitution):
    """A value that belongs to the present event, for example ``LocalSubstitution("event.reason")``.

    Args:
        expression: A name among the context's locals, with attributes by dots.
        description: How it is shown.
    """

    def __init__(self, expression: str, description: str | None = None) -> None:
        if not isinstance(expression, str):
            raise TypeError(
                f"LocalSubstitution expected Text object got '{type(expression)}' instead."
            )
        self._expression = expression
        self._description = description

    @property
    def expression(self) -> str:
        """Name and attributes."""
        return self._expression

    def describe(self) -> str:
        """Name it."""
        return f"LocalVar('{self._expression if self._description is None else self._description}')"

    def perform(self, context: LaunchContext) -> str:
        """The value as text.

        Raises:
            SubstitutionFailure: There is none of that name.
        """
        value: object = context.locals
        try:
            for name in self._expression.split("."):
                value = getattr(value, name)
        except AttributeError as error:
            raise SubstitutionFailure(f"no local '{self._expression}': {error}") from error
        return str(value)
