"""Checks of arguments, the same as in the compiled core."""

from __future__ import annotations

import operator
from typing import Any

from turtlewire.tf import datetimes

LIMIT = 2**63
"""The first stamp that does not fit into 64 bits."""


def check_frames(**frames: object) -> None:
    """Raise a TypeError unless all are strings, and a UnicodeEncodeError for invalid Unicode."""
    for argument, frame in frames.items():
        if not isinstance(frame, str):
            raise TypeError(f"{argument} must be str, not {type(frame).__name__}")
        if not frame.isascii():
            frame.encode()


def nanoseconds(**times: Any) -> list[int]:
    """Return the times, integers or ``datetime64``, as Python's integers.

    Raises:
        TypeError: A time is a float, which cannot hold a present stamp exactly.
    """
    return [_nanoseconds(argument, time) for argument, time in times.items()]


def _nanoseconds(argument: str, time: Any) -> int:
    try:
        value = operator.index(time)
    except TypeError:
        value = datetimes.nanoseconds(time, argument)
    if not -LIMIT <= value < LIMIT:
        raise OverflowError(f"{argument} does not fit into 64 bits")
    return value


def numbers(argument: str, values: Any, count: int) -> tuple[float, ...]:
    """Return a given count of floats."""
    items = tuple(values)
    if len(items) != count:
        raise ValueError(f"{argument} must have {count} numbers")
    for item in items:
        if isinstance(item, str):  # float() would take it
            raise TypeError("must be real number, not str")
    return tuple(map(float, items))
