"""Text, paths and substitutions as lists of substitutions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from launch.substitution import Substitution, TextSubstitution

if TYPE_CHECKING:
    from launch.some_substitutions_type import SomeSubstitutionsType


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """Return text, a path, a substitution or several of them as a list of substitutions.

    Raises:
        TypeError: ``subs`` has another type.
    """
    if isinstance(subs, (str, Path, Substitution)):
        return [_substitution(subs)]
    if hasattr(subs, "__iter__"):
        return [_substitution(item) for item in subs]
    raise TypeError(
        f"'{subs}' is neither text nor a substitution nor a list of them, but {type(subs).__name__}"
    )


def _substitution(item: object) -> Substitution:
    if isinstance(item, Substitution):
        return item
    if isinstance(item, (str, Path)):
        return TextSubstitution(text=str(item))
    raise TypeError(
        f"Failed to normalize given item of type '{type(item)}', "
        "when only 'str', 'Path' or 'launch.Substitution' were expected."
    )
