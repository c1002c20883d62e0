"""Words of texts: numbers with their nouns, and hints that depend on the interface of a buffer."""

from __future__ import annotations

from typing import Any, NamedTuple


def counted(count: int, noun: str) -> str:
    """Return a number with its noun: ``1 link``, ``2,000 links``."""
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


class Wording(NamedTuple):
    """The words of hints, by the interface through which a program uses a buffer.

    Attributes:
        latest: What to do to get the latest transform.
        problems: The call that lists contradictions and refused transforms.
    """

    latest: str = "leave out the time"
    problems: str = "turtlewire.Buffer.problems()"


def wording(buffer: Any) -> Wording:
    """Return the wording of a buffer's interface."""
    words: Wording = getattr(buffer, "_wording", Wording())
    return words
