"""The value of a parameter that the launch sets for all nodes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.scope import global_parameters

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("param")
class Parameter(Substitution):
    """The value of a parameter that ``SetParameter`` has set.

    Args:
        name: Its name.
        default: The value if it is not set; without one that is an error.
    """

    def __init__(
        self, name: SomeSubstitutionsType, *, default: SomeSubstitutionsType | None = None
    ) -> None:
        self._name = normalize_to_list_of_substitutions(name)
        self._default = None if default is None else normalize_to_list_of_substitutions(default)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Parameter], dict[str, Any]]:
        """Read ``$(param name [default])``."""
        if not 1 <= len(data) <= 2:
            raise TypeError("param substitution expects 1 or 2 arguments")
        return cls, {"name": data[0], "default": data[1] if len(data) == 2 else None}

    @property
    def name(self) -> list[Substitution]:
        """The name of the parameter."""
        return self._name

    def describe(self) -> str:
        """Name it."""
        return f"Parameter({described(self._name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as text.

        Raises:
            SubstitutionFailure: The parameter is not set, and there is no default.
        """
        name = perform_substitutions(context, self._name)
        # The parameter that was set last wins.
        for entry in reversed(global_parameters(context)):
            if isinstance(entry, tuple) and entry[0] == name:
                return str(entry[1])
        if self._default is None:
            raise SubstitutionFailure(f"parameter '{name}' not found")
        return perform_substitutions(context, self._default)
