"""The value of an environment variable."""

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


@expose_substitution("env")
class EnvironmentVariable(Substitution):
    """The value of an environment variable, as the launch sees it at that moment.

    Args:
        name: Its name.
        default_value: The value if it is not set; without one that is an error.
    """

    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None:
        self._name = normalize_to_list_of_substitutions(name)
        self._default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[EnvironmentVariable], dict[str, Any]]:
        """Read ``$(env NAME [default])``."""
        if not 1 <= len(data) <= 2:
            raise TypeError("env substitution expects 1 or 2 arguments")
        return cls, {"name": data[0], "default_value": data[1] if len(data) == 2 else None}

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable."""
        return self._name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value if it is not set."""
        return self._default_value

    def describe(self) -> str:
        return f"EnvVar({described(self._name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value.

        Raises:
            SubstitutionFailure: The variable is not set, and there is no default.
        """
        name = perform_substitutions(context, self._name)
        if name in context.environment:
            return context.environment[name]
        if self._default_value is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        return perform_substitutions(context, self._default_value)
