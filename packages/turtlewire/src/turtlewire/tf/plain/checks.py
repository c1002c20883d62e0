"""Checks of arguments, the same as in the compiled core."""

from __future__ import annotations

import operator
from typing import Any

from turtlewire.call_errors import frame_error
from turtlewire.tf import datetimes
from turtlewire.tf.number_errors import numbers_error

LIMIT = 2**63
"""The first stamp that does not fit into 64 bits."""


def check_frames(**frames: object) -> None:
    """Raise a TypeError unless all are strings, and a UnicodeEncodeError for invalid Unicode."""
    for argument, frame in frames.items():
        if not isinstance(frame, str):
            raise frame_error(argument, frame)
        if not frame.isascii():
            frame.encode()


def nanoseconds(**times: Any) -> list[int]:
    """Return the times, integers or ``datetime64``, as Python's integers.

    Raises:
        TypeError: A time is a float, which cannot hold a present stamp exactly.
    """
    return [_nanoseconds(argument, time) for argument, time in times.items()]


def moments(**times: Any) -> list[int | None]:
    """Return the times of a question as Python's integers; None stays None.

    Raises:
        TypeError: A time is a float, which cannot hold a present stamp exactly.
        ValueError: A time is NaT.
    """
    found = [
        None if time is None else _nanoseconds(argument, time) for argument, time in times.items()
    ]
    if -LIMIT in found:
        raise ValueError(f"{list(times)[found.index(-LIMIT)]} is NaT (not a time)")
    return found


def _nanoseconds(argument: str, time: Any) -> int:
    try:
        value = operator.index(time)
    except TypeError:
        value = datetimes.nanoseconds(time, argument)
    if not -LIMIT <= value < LIMIT:
        raise OverflowError(f"{argument} does not fit into 64 bits of nanoseconds")
    return value


def numbers(argument: str, values: Any, count: int) -> tuple[float, ...]:
    """Return a given count of floats."""
    try:
        items = tuple(values)
    except TypeError:
        raise numbers_error(argument, values, None) from None
    if len(items) != count or any(isinstance(item, str) for item in items):  # float() takes str
        raise numbers_error(argument, values, items)
    try:
        return tuple(map(float, items))
    except TypeError:
        raise numbers_error(argument, values, items) from None
