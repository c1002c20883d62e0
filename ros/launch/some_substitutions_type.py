"""What may stand where text is substituted."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Union

from launch.substitution import Substitution

__all__ = ["SomeSubstitutionsType"]

#: Text, a path, one substitution, or several of these whose texts are joined.
SomeSubstitutionsType = Union[str, Path, Substitution, Iterable[Union[str, Path, Substitution]]]
