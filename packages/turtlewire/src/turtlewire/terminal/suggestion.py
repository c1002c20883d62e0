"""Suggestions for a name that does not exist."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["did_you_mean"]


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a line with the nearest known names; empty if no name is similar."""
    import difflib

    near = difflib.get_close_matches(name, list(dict.fromkeys(known)), n=3)
    return f"Did you mean: {', '.join(near)}" if near else ""
