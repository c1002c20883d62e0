"""Words of hints that depend on the interface of a buffer."""

from __future__ import annotations

from typing import Any, NamedTuple


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
