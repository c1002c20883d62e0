"""The error of conditions whose text is neither true nor false."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.substitution import Substitution


class InvalidConditionExpressionError(Exception):
    """The text of a condition is neither true nor false.

    Args:
        expression: The text.
        unexpanded_expression: The substitutions that gave it.
        valid_expressions: The texts that mean true, and the texts that mean false.
    """

    def __init__(
        self,
        expression: str,
        unexpanded_expression: Iterable[Substitution],
        valid_expressions: Iterable[str],
    ) -> None:
        expected = " or ".join(f"'{valid}'" for valid in valid_expressions)
        super().__init__(
            f"invalid condition expression, expected one of {expected} but got '{expression}'"
        )
        self.unexpanded_expression = list(unexpanded_expression)
