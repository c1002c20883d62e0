"""Prefixes of parameters' names: ``a.b`` is one of ``a.b.c``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.parameter import PARAMETER_SEPARATOR_STRING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["is_listed", "prefixes_of"]


def is_listed(name: str, prefixes: list[str], depth: int) -> bool:
    """Return True if a list of the names below ``prefixes`` has ``name``.

    Args:
        name: Of a parameter.
        prefixes: Names, or beginnings of names up to a dot; all names if empty.
        depth: How many levels below a prefix; 0 means all.
    """

    def is_near(rest: str) -> bool:
        return depth == 0 or rest.count(PARAMETER_SEPARATOR_STRING) < depth

    if not prefixes:
        return is_near(name)
    return any(
        name == prefix
        or (
            name.startswith(f"{prefix}{PARAMETER_SEPARATOR_STRING}")
            and is_near(name[len(prefix) + 1 :])
        )
        for prefix in prefixes
    )


def prefixes_of(names: Iterable[str]) -> list[str]:
    """Return the longest prefix of each name that has one, each once, in their order."""
    parents = (name.rpartition(PARAMETER_SEPARATOR_STRING)[0] for name in names)
    return list(dict.fromkeys(parent for parent in parents if parent))
