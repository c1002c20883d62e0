"""Evaluates text as true or false."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch.conditions.invalid_condition_expression_error import InvalidConditionExpressionError
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.substitution import Substitution

VALID_TRUE_EXPRESSIONS = ["true", "1"]
VALID_FALSE_EXPRESSIONS = ["false", "0"]


def evaluate_condition_expression(
    context: LaunchContext, expression: Iterable[Substitution]
) -> bool:
    """Perform the substitutions and read the text as true or false.

    Args:
        context: The context of the launch.
        expression: Gives ``true``, ``1``, ``false`` or ``0``, in small or capital letters.

    Raises:
        InvalidConditionExpressionError: The text is something else.
    """
    expression = list(expression)
    text = perform_substitutions(context, expression).strip().lower()
    if text in VALID_TRUE_EXPRESSIONS:
        return True
    if text in VALID_FALSE_EXPRESSIONS:
        return False
    valid = ["|".join(VALID_TRUE_EXPRESSIONS), "|".join(VALID_FALSE_EXPRESSIONS)]
    raise InvalidConditionExpressionError(text, expression, valid)
