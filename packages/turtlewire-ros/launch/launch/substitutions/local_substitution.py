"""A value of the current event."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LocalSubstitution(Substitution):
    """A value of the current event, for example ``LocalSubstitution("event.reason")``.

    Args:
        expression: A name among the context's locals, and what Python allows to follow it:
            attributes, indices. A launch file runs code by its nature; this is no less trusted.
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

    @property
    def description(self) -> str | None:
        """Description for messages, or None."""
        return self._description

    def describe(self) -> str:
        return f"LocalVar('{self._expression if self._description is None else self._description}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as text.

        Raises:
            SubstitutionFailure: The local does not exist.
        """
        try:
            value = eval(f"locals.{self._expression}", {}, {"locals": context.locals})  # noqa: S307
        except Exception as error:
            raise SubstitutionFailure(f"no local '{self._expression}': {error}") from error
        return str(value)
