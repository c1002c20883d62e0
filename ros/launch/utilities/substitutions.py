"""Text, paths and substitutions as lists of substitutions, and those as text."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities.text import TextSubstitution

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["normalize_to_list_of_substitutions", "perform_substitutions"]


def normalize_to_list_of_substitutions(subst: SomeSubstitutionsType) -> list[Substitution]:
    """Text, a path, a substitution or several of them, as a list of substitutions.

    Raises:
        TypeError: It is something else.
    """
    if isinstance(subst, (str, Path, Substitution)):
        return [_substitution(subst)]
    if hasattr(subst, "__iter__"):
        return [_substitution(item) for item in subst]
    raise TypeError(
        f"'{subst}' is neither text nor a substitution nor a list of them, "
        f"but {type(subst).__name__}"
    )


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """The joined texts of the substitutions."""
    return "".join(context.perform_substitution(sub) for sub in subs)


def _substitution(item: object) -> Substitution:
    if isinstance(item, Substitution):
        return item
    if isinstance(item, (str, Path)):
        return TextSubstitution(text=str(item))
    raise TypeError(
        f"Failed to normalize given item of type '{type(item)}', "
        "when only 'str', 'Path' or 'launch.Substitution' were expected."
    )
