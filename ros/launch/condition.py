"""Whether an action takes place."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.launch_context import LaunchContext

__all__ = ["Condition"]


class Condition:
    """Asks a predicate, each time the action that has it is visited."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate
        self._last_result: bool | None = None

    def evaluate(self, context: LaunchContext) -> bool:
        """Ask now; a condition without predicate holds."""
        self._last_result = self._predicate is None or bool(self._predicate(context))
        return self._last_result

    def evaluated_value(self) -> bool | None:
        """The last answer, or None when it was never asked."""
        return self._last_result
