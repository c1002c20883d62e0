"""Limits of the tools: how often they are called, how long their answers are."""

from __future__ import annotations

import json
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from turtlewire.cli.assistant.permissions import RefusedCallError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LONGEST_ANSWER", "RateLimit", "bounded_json", "seconds_within"]

#: Characters of an answer.
LONGEST_ANSWER = 20_000
_PERIOD_S = 60.0
#: Items of a list and characters of a string, from the longest answer to the shortest.
_CUTS = ((200, 2000), (50, 500), (10, 200), (3, 100), (1, 50), (0, 20))


class RateLimit:
    """Counts the calls of the last minute.

    Args:
        most: How many calls a minute may have.
        clock: Returns the time in seconds.
    """

    def __init__(self, most: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._most = most
        self._clock = clock
        self._calls: deque[float] = deque()

    def count(self) -> None:
        """Count a call. A refused call does not count.

        Raises:
            RefusedCallError: The last minute had too many calls.
        """
        now = self._clock()
        while self._calls and now - self._calls[0] >= _PERIOD_S:
            self._calls.popleft()
        if len(self._calls) >= self._most:
            wait_s = _PERIOD_S - (now - self._calls[0])
            raise RefusedCallError(
                f"Too many calls: {self._most} in a minute are allowed (turtlewire mcp --rate). "
                f"Try again in {wait_s:.1f} s."
            )
        self._calls.append(now)


def seconds_within(value: float, name: str, most: float) -> float:
    """Return a duration that a tool may take.

    Raises:
        RefusedCallError: The duration is not above 0, or too long.
    """
    if not 0.0 < value <= most:  # also refuses NaN
        raise RefusedCallError(
            f"{name} is {value:g}; it must be above 0 and at most {most:g} seconds"
        )
    return value


def bounded_json(value: Any) -> str:
    """Return JSON of at most `LONGEST_ANSWER` characters.

    Where lists and strings had to be cut, the text says so: at each place, and once in front.
    """
    for items, characters in _CUTS:
        cut = _cut(value, items, characters)
        note = ""
        if cut != value:
            note = f"(shortened: at most {items} items of a list, {characters} of a string)\n"
        text = note + json.dumps(cut)
        if len(text) <= LONGEST_ANSWER:
            return text
    return f"{text[: LONGEST_ANSWER - 40]}... (the end is left out)"


def _cut(value: Any, items: int, characters: int) -> Any:
    if isinstance(value, dict):
        return {key: _cut(item, items, characters) for key, item in value.items()}
    if isinstance(value, list | tuple):
        kept = [_cut(item, items, characters) for item in value[:items]]
        rest = len(value) - items
        return [*kept, f"... and {rest} more"] if rest > 0 else kept
    if isinstance(value, str) and len(value) > characters:
        return f"{value[:characters]}... and {len(value) - characters} more characters"
    return value
