"""Paths joined from parts."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("path-join")
class PathJoinSubstitution(Substitution):
    """Joins parts to a path.

    Args:
        substitutions: The parts; one that is a list is joined to a text first.
    """

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType]) -> None:
        parts = [substitutions] if isinstance(substitutions, (str, Substitution)) else substitutions
        self._substitutions = [normalize_to_list_of_substitutions(part) for part in parts]

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[PathJoinSubstitution], dict[str, Any]]:
        """Read ``$(path-join part ...)``."""
        if not data:
            raise ValueError("PathJoinSubstitution expects at least 1 argument")
        return cls, {"substitutions": data}

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """The parts."""
        return self._substitutions

    def describe(self) -> str:
        return f"PathJoin({', '.join(map(described, self._substitutions))})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        return os.path.join(*(perform_substitutions(context, part) for part in self._substitutions))

    def __truediv__(self, part: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return the path with another part."""
        return PathJoinSubstitution([*self._substitutions, part])


class PathSubstitution(PathJoinSubstitution):
    """A path that ``/`` extends: ``PathSubstitution(LaunchConfiguration("folder")) / "launch"``.

    Args:
        path: The first part.
    """

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__([path])
