"""Times that are not integers: NumPy's ``datetime64``, and what can be made one, as pandas' times.

This module does not import NumPy: a caller that has such a time has imported it.
"""

from __future__ import annotations

import operator
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["as_nanoseconds", "nanoseconds", "nanoseconds_array"]


def nanoseconds(time: Any, argument: str) -> int:
    """Return a ``datetime64``, or a pandas ``Timestamp``, in nanoseconds since 1970.

    Raises:
        TypeError: ``time`` has another type; the message contains ``argument``.
        ValueError: ``time`` is NaT, or does not fit into 64 bits.
    """
    numpy = sys.modules.get("numpy")
    moment = time.to_datetime64() if hasattr(time, "to_datetime64") else time
    if numpy is None or not isinstance(moment, numpy.datetime64):
        raise TypeError(f"{argument} must be an int of nanoseconds, not {type(time).__name__}")
    return int(nanoseconds_array(numpy.asarray([moment]))[0])


def as_nanoseconds(time: Any, argument: str) -> int:
    """Return an integer of Python or NumPy as an int; anything else as `nanoseconds` takes it."""
    try:
        return operator.index(time)
    except TypeError:
        return nanoseconds(time, argument)


def nanoseconds_array(times: NDArray[np.datetime64]) -> NDArray[np.int64]:
    """Elements of ``datetime64`` of any unit, in nanoseconds since 1970.

    Raises:
        ValueError: A time is NaT, or does not fit into 64 bits.
    """
    import numpy as np

    if np.isnat(times).any():
        raise ValueError("a time is NaT (not a time)")
    try:
        fine = times.astype("datetime64[ns]")
        fits = bool((fine.astype(times.dtype) == times).all())
    except OverflowError:  # of NumPy 2.5; older ones wrap around
        fits = False
    if not fits:
        raise ValueError("a time does not fit into 64 bits of nanoseconds: 1677 to 2262")
    return fine.astype(np.int64)
