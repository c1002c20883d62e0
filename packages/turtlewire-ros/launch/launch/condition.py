"""Decides whether an action takes effect."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Condition:
    """Evaluates a predicate at each visit of the action that has it."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate
        self._last_result: bool | None = None

    def describe(self) -> str:
        """Return the text of this condition in descriptions."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """Evaluate it now; a condition without a predicate is true."""
        self._last_result = self._predicate is None or bool(self._predicate(context))
        return self._last_result

    def evaluated_value(self) -> bool | None:
        """Return the last result, or None if it was never evaluated."""
        return self._last_result
