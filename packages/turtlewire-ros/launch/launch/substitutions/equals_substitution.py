"""Comparison of two texts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_substitution("equals")
class EqualsSubstitution(Substitution):
    """True if two texts are equal.

    Numbers are compared as numbers; ``true`` equals ``1``, and ``false`` equals ``0``.

    Args:
        left: The one: text, substitutions, a number or a truth value.
        right: The other.
    """

    def __init__(self, left: Any, right: Any) -> None:
        self._left = _normalized(left)
        self._right = _normalized(right)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[EqualsSubstitution], dict[str, Any]]:
        """Read ``$(equals left right)``."""
        if len(data) != 2:
            raise TypeError(f"{cls.__name__} expects 2 arguments")
        return cls, {"left": data[0], "right": data[1]}

    @property
    def left(self) -> list[Substitution]:
        """The one."""
        return self._left

    @property
    def right(self) -> list[Substitution]:
        """The other."""
        return self._right

    def describe(self) -> str:
        return f"{type(self).__name__}({described(self._left)} {described(self._right)})"

    def perform(self, context: LaunchContext) -> str:
        return "true" if self._equal(context) else "false"

    def _equal(self, context: LaunchContext) -> bool:
        left, right = (
            perform_substitutions(context, self._left),
            perform_substitutions(context, self._right),
        )
        if left == right:
            return True
        try:
            return math.isclose(_number(left), _number(right))
        except ValueError:
            return False


def _number(text: str) -> float:
    lowered = text.strip().lower()
    return float(lowered == "true") if lowered in ("true", "false") else float(text)


def _normalized(value: Any) -> list[Substitution]:
    if isinstance(value, bool):
        return normalize_to_list_of_substitutions(str(value).lower())
    if isinstance(value, (int, float)):
        return normalize_to_list_of_substitutions(str(value))
    return normalize_to_list_of_substitutions("" if value is None else value)
