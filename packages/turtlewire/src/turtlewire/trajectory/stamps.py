"""The stamps of a trajectory: their conversion, and the gaps between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from turtlewire.tf.array_arguments import int64_stamps
from turtlewire.tf.datetimes import as_nanoseconds

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.tf.datetimes import Span

__all__ = ["Gap", "as_stamps", "find_gaps"]

#: A pause this many times as long as the median between two samples counts as a gap.
_GAP_FACTOR = 10
#: Pauses shorter than this do not count as gaps, even if the other samples are regular.
_SHORTEST_GAP_NS = 500_000_000


class Gap(NamedTuple):
    """A time without data, in nanoseconds: from the last sample before it to the first after it."""

    start_ns: int
    end_ns: int


def as_stamps(stamps: ArrayLike) -> NDArray[np.int64]:
    """Times as nanoseconds since 1970.

    Args:
        stamps: Integers (nanoseconds) or ``datetime64``, shape (N,).

    Returns:
        (N,) int64.

    Raises:
        TypeError: The array holds something else. Floats are refused: a double holds the seconds
            since 1970 only to 0.24 microseconds.
        OverflowError: A stamp does not fit into 64 bits.
        ValueError: The array has not one dimension, does not increase or contains NaT.
    """
    array = np.asarray(stamps)
    if array.dtype.kind not in "iuM" and array.size:
        advice = ""
        if array.ndim == 2:
            advice = "; stamps come before the poses"
        elif array.dtype.kind == "f":
            advice = "; for seconds, write np.round(seconds * 1e9).astype(np.int64)"
        elif not array.ndim:
            advice = "; to read a file, call Trajectory.load(path)"
        raise TypeError(
            f"expected stamps in integer nanoseconds or datetime64, got {array.dtype}{advice}"
        )
    if array.ndim != 1:
        raise ValueError(f"expected stamps of shape (N,), got {array.shape}")
    array = int64_stamps(array)
    back = np.flatnonzero(array[1:] <= array[:-1])
    if len(back):
        row = int(back[0])
        raise ValueError(
            f"stamps must increase; stamp {row + 1} does not follow stamp {row}; sort rows and "
            "leave out equal stamps: stamps, rows = np.unique(stamps, return_index=True)"
        )
    return array


def find_gaps(stamps_ns: NDArray[np.int64], max_gap_ns: Span | None = None) -> list[Gap]:
    """Pauses in increasing stamps (N,) that are longer than ``max_gap_ns``.

    None uses ten times the median pause, and at least half a second.
    """
    pauses = np.diff(stamps_ns)
    if not len(pauses):
        return []
    if max_gap_ns is None:
        longest = max(_SHORTEST_GAP_NS, int(_GAP_FACTOR * np.median(pauses)))
    else:
        longest = as_nanoseconds(max_gap_ns, "max_gap_ns")
    return [Gap(int(stamps_ns[i]), int(stamps_ns[i + 1])) for i in np.flatnonzero(pauses > longest)]
