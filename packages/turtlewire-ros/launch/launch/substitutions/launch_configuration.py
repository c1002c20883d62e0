"""The value of a launch configuration."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("var")
class LaunchConfiguration(Substitution):
    """The value of a launch configuration.

    Args:
        variable_name: Its name.
        default: The value if it is not set; without one that is an error. Other values than text
            are written as text.
    """

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any | None = None) -> None:
        self._variable_name = normalize_to_list_of_substitutions(variable_name)
        self._default = (
            None if default is None else normalize_to_list_of_substitutions(_as_text(default))
        )

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[LaunchConfiguration], dict[str, Any]]:
        """Read ``$(var name [default])``."""
        if not 1 <= len(data) <= 2:
            raise TypeError("var substitution expects 1 or 2 arguments")
        return cls, {"variable_name": data[0], "default": data[1] if len(data) == 2 else None}

    @property
    def variable_name(self) -> list[Substitution]:
        """The name of the launch configuration."""
        return self._variable_name

    def describe(self) -> str:
        return f"LaunchConfig({described(self._variable_name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value.

        Raises:
            SubstitutionFailure: The configuration is not set, and there is no default.
        """
        name = perform_substitutions(context, self._variable_name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self._default is None:
            raise SubstitutionFailure(f"launch configuration '{name}' does not exist")
        return perform_substitutions(context, self._default)


def _as_text(value: Any) -> SomeSubstitutionsType:
    if isinstance(value, (str, Substitution)):
        return value
    if hasattr(value, "__iter__"):
        return [item if isinstance(item, (str, Substitution)) else str(item) for item in value]
    return str(value)
