"""Times that are not integers: ``datetime64``, and times that convert to it, such as pandas'.

This module does not import NumPy: a caller with such a time has already imported it.
"""

from __future__ import annotations

import operator
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing import SupportsIndex, TypeAlias

    import numpy as np
    from numpy.typing import NDArray

    #: A time: nanoseconds since 1970 or since another beginning; never a float.
    Stamp: TypeAlias = SupportsIndex | np.datetime64
    #: A length of time: nanoseconds; never a float.
    Span: TypeAlias = SupportsIndex | np.timedelta64

__all__ = ["as_nanoseconds", "nanoseconds", "nanoseconds_array"]


#: Arguments that are lengths of time.
_SPANS = {
    "cache_time_ns",
    "extrapolate_ns",
    "interval_ns",
    "max_age_ns",
    "max_diff_ns",
    "max_gap_ns",
    "offset_ns",
    "timeout_ns",
}


def nanoseconds(time: Any, argument: str) -> int:
    """Return a ``datetime64``, or a pandas ``Timestamp``, in nanoseconds since 1970.

    A length of time is a ``timedelta64`` instead.

    Raises:
        TypeError: ``time`` has another type; the message contains ``argument``.
        ValueError: ``time`` is NaT, or does not fit into 64 bits.
    """
    numpy = sys.modules.get("numpy")
    kind = "timedelta64" if argument in _SPANS else "datetime64"
    convert = getattr(time, f"to_{kind}", None)  # pandas
    moment = time if convert is None else convert()
    if numpy is None or not isinstance(moment, getattr(numpy, kind)):
        raise TypeError(
            f"{argument} must be an int of nanoseconds or a numpy.{kind}, not "
            f"{type(time).__name__}{_remedy(time, argument)}"
        )
    return int(nanoseconds_array(numpy.asarray([moment]))[0])


_REMEDIES = {
    "float": "for seconds, write round(seconds * 1e9)",
    "datetime": "write round(time.timestamp() * 1e9)",
    "timedelta": "write numpy.timedelta64(time)",
    "str": "write numpy.datetime64(time) for a date",
}


def _remedy(time: Any, argument: str) -> str:
    """Return what to write instead, as the end of an error's text; empty if that is not known."""
    text = _REMEDIES.get("float" if isinstance(time, float) else type(time).__name__, "")
    if hasattr(time, "nanoseconds"):  # rclpy's
        text = "pass its nanoseconds"
    elif hasattr(time, "sec") and hasattr(time, "nanosec"):  # of a message
        text = "write time.sec * 1_000_000_000 + time.nanosec"
    elif isinstance(time, str) and argument in _SPANS:
        text = ""
    elif time is None and argument == "stamp_ns":
        text = "for a transform that holds at all times, call set_static_transform"
    elif hasattr(time, "__len__") and argument == "stamp_ns" and not text:
        text = "for several times, call lookup_transforms or set_transforms"
        if len(time) == 3:
            text = f"the translation comes after the stamp; {text}"
    return text and f"; {text}"


def as_nanoseconds(time: Any, argument: str) -> int:
    """Return an integer of Python or NumPy as an int; anything else as `nanoseconds` takes it."""
    try:
        return operator.index(time)
    except TypeError:
        pass  # the error of `nanoseconds` shall not have this one as its context
    return nanoseconds(time, argument)


def nanoseconds_array(times: NDArray[Any]) -> NDArray[np.int64]:
    """Elements of ``datetime64`` or ``timedelta64`` of any unit, in nanoseconds.

    Raises:
        ValueError: A time is NaT, or does not fit into 64 bits.
    """
    import numpy as np

    if np.isnat(times).any():
        raise ValueError("a time is NaT (not a time)")
    try:
        fine = times.astype(f"{times.dtype.kind}8[ns]")
        fits = bool((fine.astype(times.dtype) == times).all())
    except OverflowError:  # of NumPy 2.5; older ones wrap around
        fits = False
    if not fits:
        raise ValueError("a time does not fit into 64 bits of nanoseconds: 1677 to 2262")
    return fine.astype(np.int64)
