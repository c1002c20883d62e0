"""The trajectory of a frame, sampled from a transform buffer."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.tf.links import links
from turtlewire.trajectory.stamps import as_stamps, find_gaps
from turtlewire.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.tf.datetimes import Span
    from turtlewire.tf.implementation import BaseBuffer

__all__ = ["moving_links", "sample_trajectory"]

#: This many poses take a gigabyte: 1 kHz for five and a half hours.
_MOST_POSES = 20_000_000


def sample_trajectory(
    buffer: BaseBuffer,
    target_frame: str,
    source_frame: str,
    *,
    stamps: ArrayLike | None = None,
    rate_hz: float | None = None,
    max_gap_ns: Span | None = None,
) -> Trajectory:
    """Return the poses of a frame in another over time.

    Args:
        buffer: Where the transforms are.
        target_frame: The frame in which the poses are given.
        source_frame: The frame that moves.
        stamps: The times wanted, integer nanoseconds or ``datetime64``; those without an answer are
            left out.
        rate_hz: Poses at this rate through the time that all links cover. Without ``stamps`` and
            ``rate_hz``: at each time at which a link on the way has a sample.
        max_gap_ns: Pauses between samples that are longer are gaps: no pose lies within one. None
            takes ten times the median pause of the link, and at least half a second.

    Returns:
        The trajectory, with its gaps.

    Raises:
        TransformException: The frames are unknown or not connected.
        ValueError: All transforms in the chain are static and no stamps were given, both stamps
            and a rate were given, or the rate is not positive or gives too many poses.
    """
    if stamps is not None and rate_hz is not None:
        raise ValueError("pass either `stamps` or `rate_hz`, not both")
    moving = moving_links(buffer, target_frame, source_frame)
    histories = [_stamps_of(buffer, child) for child in moving]
    gaps = sorted({gap for stamps_ns in histories for gap in find_gaps(stamps_ns, max_gap_ns)})
    if stamps is not None:
        wanted = as_stamps(stamps)
    else:
        if not histories:
            raise ValueError(
                f"nothing moves between '{target_frame}' and '{source_frame}', so no transform in "
                "the chain has stamps to use: pass `stamps`"
            )
        wanted = _times(histories, rate_hz)
    for gap in gaps:
        wanted = wanted[(wanted <= gap.start_ns) | (wanted >= gap.end_ns)]
    poses = buffer.lookup_transforms(target_frame, source_frame, wanted, errors="nan")
    found = ~np.isnan(poses[:, 0])
    if len(wanted) and not found.any():  # the first lookup says why
        buffer.lookup_transform(target_frame, source_frame, int(wanted[0]))
    return Trajectory(wanted[found], poses[found], target_frame, source_frame, tuple(gaps))


def moving_links(buffer: BaseBuffer, target: str, source: str) -> list[str]:
    """Return the children of the moving links between two frames.

    Raises:
        TransformException: The frames are unknown or not connected.
    """
    buffer.lookup_transform(target, source)  # raises what is wrong with the names
    by_child = {link.child_frame: link for link in links(buffer)}

    def to_root(frame: str) -> list[str]:
        way = []
        while frame in by_child and frame not in way:
            way.append(frame)
            frame = by_child[frame].parent_frame
        return way

    target_way, source_way = to_root(target), to_root(source)
    shared = set(target_way) & set(source_way)
    return [
        child
        for child in (*target_way, *source_way)
        if child not in shared and not by_child[child].static
    ]


def _stamps_of(buffer: BaseBuffer, child: str) -> NDArray[np.int64]:
    return np.unique(buffer._stamps(child))


def _times(histories: list[NDArray[np.int64]], rate_hz: float | None) -> NDArray[np.int64]:
    """Times within the interval that all histories cover."""
    start = max(int(history[0]) for history in histories)
    end = min(int(history[-1]) for history in histories)
    if rate_hz is None:
        times = np.unique(np.concatenate(histories))
        return times[(times >= start) & (times <= end)]
    if not 0.0 < rate_hz < math.inf:  # also true for NaN
        raise ValueError(f"the rate is {rate_hz} Hz; it must be positive and finite")
    length_s = max(0, end - start) / 1e9
    if length_s * rate_hz >= _MOST_POSES:
        raise ValueError(
            f"a rate of {rate_hz:g} Hz makes more than {_MOST_POSES:,} poses of {length_s:.3f} s; "
            f"take at most {0.999 * _MOST_POSES / length_s:.4g} Hz"
        )
    count = int((end - start) * rate_hz / 1e9) + 1 if end >= start else 0
    return start + np.round(np.arange(count) * (1e9 / rate_hz)).astype(np.int64)
