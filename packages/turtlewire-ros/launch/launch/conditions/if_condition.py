"""True when a text is true."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.conditions.evaluate_condition_expression_impl import evaluate_condition_expression
from launch.substitution import described
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class IfCondition(Condition):
    """True when a text is true.

    Args:
        predicate_expression: The text: ``true``, ``1``, ``false`` or ``0``.
    """

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        self._predicate_expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=self._predicate_func)

    def describe(self) -> str:
        return f"IfCondition({described(self._predicate_expression)})"

    def _predicate_func(self, context: LaunchContext) -> bool:
        return evaluate_condition_expression(context, self._predicate_expression)
