"""The type of arguments that are text or substitutions."""

from collections.abc import Iterable
from pathlib import Path

from launch.substitution import Substitution

#: Text, a path, one substitution, or several of these whose texts are joined.
SomeSubstitutionsType = str | Path | Substitution | Iterable[str | Path | Substitution]

#: The same for ``isinstance``.
SomeSubstitutionsType_types_tuple = (str, Path, Substitution, Iterable)
