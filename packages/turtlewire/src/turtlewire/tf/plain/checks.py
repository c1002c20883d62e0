"""Checks of arguments, the same as in the compiled core, and arrays as the loops use them."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any

from turtlewire.call_errors import frame_error
from turtlewire.tf import datetimes
from turtlewire.tf.number_errors import numbers_error

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

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


def times_of(stamps: int | ArrayLike | None) -> tuple[list[int | None], bool]:
    """Return the stamps, and whether a single one was given instead of an array."""
    import numpy as np

    if stamps is None:
        return [None], True
    if isinstance(stamps, (int, np.integer, np.datetime64)) or hasattr(stamps, "to_datetime64"):
        return moments(stamps=stamps), True
    return [*stamp_list(stamps)], False


def stamp_list(stamps: ArrayLike) -> list[int]:
    """The stamps of a one-dimensional array of integers or ``datetime64``, in nanoseconds."""
    from turtlewire.tf.array_arguments import stamp_array

    times: list[int] = stamp_array(stamps).tolist()
    if -LIMIT in times:
        raise ValueError("a time is NaT (not a time)")
    return times


def check_errors(errors: str, other: str = "nan") -> bool:
    """Return True for the other choice than "raise".

    Raises:
        ValueError: ``errors`` is neither.
    """
    if errors not in ("raise", other):
        raise ValueError(f"errors must be 'raise' or {other!r}, not {errors!r}")
    return errors == other


def check_shape(array: NDArray[Any] | None, shape: tuple[int, ...], name: str) -> None:
    """Raise ValueError unless the array is None or has this shape."""
    if array is not None and array.shape != shape:
        raise ValueError(f"{name} must have the shape {shape}, not {array.shape}")


def output_array(out: NDArray[np.float64] | None, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return the caller's ``out``, checked, or a new array of this shape."""
    import numpy as np

    if out is None:
        return np.empty(shape)
    if (
        not isinstance(out, np.ndarray)
        or out.dtype != np.float64
        or not out.flags.c_contiguous
        or not out.flags.writeable
    ):
        raise TypeError("out must be a writable, C-contiguous float64 array")
    check_shape(out, shape, "out")
    return out


def point_arrays(points: ArrayLike, out: NDArray[Any] | None) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the points to read, as float32 or float64, and the array to write to."""
    import numpy as np

    from turtlewire.tf.array_arguments import point_array

    given = point_array(points)
    if out is None:
        return given, np.empty_like(given)
    if (
        not isinstance(out, np.ndarray)
        or out.dtype != given.dtype
        or not out.flags.c_contiguous
        or not out.flags.writeable
    ):
        raise TypeError(
            "out must be a writable, C-contiguous (N, 3) array of the same type as points"
        )
    check_shape(out, given.shape, "out")
    return (given.copy() if np.may_share_memory(given, out) else given), out
