"""Permissions and limits of an assistant: topics, services, calls, answers; the errors it reads."""

from __future__ import annotations

import json
import shlex
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any


class RefusedCallError(Exception):
    """A call of a tool that cannot be done; the text says why, and what can be done instead."""


def full_name(name: str) -> str:
    """Return the name of a topic or service with the slash that an assistant may have left out."""
    return name if name.startswith("/") else f"/{name}"


class Permissions:
    """Names of topics and services; one that ends in ``*`` stands for all that begin like it.

    Args:
        patterns: The values of ``--allow``.

    Raises:
        ValueError: A pattern is empty, or has a ``*`` before its end.
    """

    def __init__(self, patterns: Sequence[str] = ()) -> None:
        for pattern in patterns:
            if not pattern or "*" in pattern[:-1]:
                raise ValueError(
                    f"{pattern!r} is not the name of a topic or service, such as /turtle1/cmd_vel, "
                    "or the beginning of names with * at its end, such as '/turtle1/*'"
                )
        self._patterns = ["*" if each == "*" else full_name(each) for each in patterns]

    def __bool__(self) -> bool:
        return bool(self._patterns)

    def __str__(self) -> str:
        return ", ".join(self._patterns) or "nothing"

    def allow(self, name: str) -> bool:
        """Return True if a topic or service may be used."""
        return any(
            name.startswith(pattern[:-1]) if pattern.endswith("*") else name == pattern
            for pattern in self._patterns
        )

    def require(self, name: str, action: str) -> None:
        """Make sure that a topic or service may be used.

        Args:
            name: Its full name.
            action: What was asked for, such as ``publish to``.

        Raises:
            RefusedCallError: The name is not allowed.
        """
        if not self.allow(name):
            raise RefusedCallError(
                f"Refused to {action} {name}. Allowed: {self}. Only the person who starts this "
                f"server can allow more: turtlewire mcp --allow {shlex.quote(name)}"
            )


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
