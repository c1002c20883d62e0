"""True when a launch configuration has a value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.substitution import described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class LaunchConfigurationEquals(Condition):
    """True when a launch configuration has a value.

    Deprecated in ROS 2: ``IfCondition`` with ``EqualsSubstitution`` says the same.

    Args:
        launch_configuration_name: Name of the configuration; one that is not set equals nothing but
            None.
        expected_value: The value.
    """

    def __init__(
        self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None
    ) -> None:
        self._name = launch_configuration_name
        self._expected = (
            None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        )
        super().__init__(predicate=self._predicate_func)

    def describe(self) -> str:
        text = "None" if self._expected is None else described(self._expected)
        return f"{type(self).__name__}({self._name}, {text})"

    def _predicate_func(self, context: LaunchContext) -> bool:
        expected = (
            None if self._expected is None else perform_substitutions(context, self._expected)
        )
        return context.launch_configurations.get(self._name) == expected
