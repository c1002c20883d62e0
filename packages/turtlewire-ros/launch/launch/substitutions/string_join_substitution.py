"""Text joined from parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("string-join")
class StringJoinSubstitution(Substitution):
    """Joins parts with a delimiter.

    Args:
        substitutions: The parts; one that is a list is joined to a text first.
        delimiter: What stands between them.
    """

    def __init__(
        self,
        substitutions: Iterable[SomeSubstitutionsType],
        delimiter: SomeSubstitutionsType = "",
    ) -> None:
        self._substitutions = [normalize_to_list_of_substitutions(part) for part in substitutions]
        self._delimiter = normalize_to_list_of_substitutions(delimiter)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[StringJoinSubstitution], dict[str, Any]]:
        """Read ``$(string-join delimiter part ...)``."""
        if len(data) < 2:
            raise ValueError(
                "string-join substitution expects at least 2 arguments: 1 delimiter + at least 1 "
                "component"
            )
        return cls, {"delimiter": data[0], "substitutions": data[1:]}

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """The parts."""
        return self._substitutions

    @property
    def delimiter(self) -> list[Substitution]:
        """The text between the parts."""
        return self._delimiter

    def describe(self) -> str:
        return f"StringJoin({', '.join(map(described, self._substitutions))})"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        return perform_substitutions(context, self._delimiter).join(
            perform_substitutions(context, part) for part in self._substitutions
        )
