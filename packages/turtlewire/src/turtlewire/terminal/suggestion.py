"""Suggestions for a name that does not exist."""

from __future__ import annotations

from collections.abc import Iterable

#: Names that are so much less similar than the nearest one are noise.
_WORSE = 0.15


def did_you_mean(name: str, known: Iterable[str], similarity: float = 0.6) -> str:
    """Return a line with the nearest known names; empty if none is near.

    Args:
        name: A name that is not known.
        known: All names.
        similarity: The least similarity of a near name, from 0 to 1, as `difflib` defines it.
    """
    import difflib

    near = difflib.get_close_matches(name, list(dict.fromkeys(known)), n=3, cutoff=similarity)
    if not near:
        return ""
    ratios = [difflib.SequenceMatcher(None, each, name).ratio() for each in near]
    kept = [each for each, ratio in zip(near, ratios, strict=True) if ratio > ratios[0] - _WORSE]
    return f"Did you mean: {', '.join(kept)}"
