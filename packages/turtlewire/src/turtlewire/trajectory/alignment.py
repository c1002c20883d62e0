"""Brings an estimate into the frame of a reference: pairs of poses, and the transform between them.

Source: Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
IEEE PAMI 13 (1991).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from turtlewire.geometry import arrays
from turtlewire.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["ALIGNMENTS", "Alignment", "AlignmentName", "align", "associate"]

AlignmentName = Literal["none", "origin", "yaw", "se3", "sim3"]

#: No sensor returns poses so fast; its square is a pause of a millisecond.
_SHORTEST_PAUSE_NS = 1000

#: The ways to align, by the parts of the estimate that may be moved.
ALIGNMENTS = ("none", "origin", "yaw", "se3", "sim3")


class Alignment(NamedTuple):
    """A similarity transform: ``reference = scale * rotate(rotation, estimate) + translation``.

    Attributes:
        rotation: (4,) unit quaternion x, y, z, w.
        translation: (3,) in metres.
        scale: 1 except for ``sim3``.
    """

    rotation: NDArray[np.float64]
    translation: NDArray[np.float64]
    scale: float

    def apply(self, trajectory: Trajectory) -> Trajectory:
        """Return the trajectory with this transform applied."""
        positions = (
            self.scale * arrays.rotate(self.rotation, trajectory.positions) + self.translation
        )
        rotations = arrays.multiply(self.rotation, trajectory.rotations)
        return Trajectory(
            trajectory.stamps_ns,
            np.hstack((positions, rotations)),
            trajectory.target_frame,
            trajectory.source_frame,
            trajectory.gaps,
        )


def associate(
    reference: Trajectory, estimate: Trajectory, max_diff_ns: int, offset_ns: int = 0
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of rows: for each pose of the shorter trajectory the nearest one of the other.

    If both have as many poses, the estimate counts as the shorter. Of two poses as near the earlier
    is taken. (evo has the same rules, but compares stamps as doubles: a difference of exactly
    ``max_diff_ns`` is kept here, and may be dropped there.)

    Args:
        reference: The reference.
        estimate: The estimate.
        max_diff_ns: Pairs whose stamps differ by more are dropped.
        offset_ns: Added to the stamps of the estimate.

    Returns:
        Rows of the reference and of the estimate, of equal length.

    Raises:
        ValueError: No poses can be paired (the message names both time ranges), the stamps have
            different units, or the offset is too large.
    """
    if max_diff_ns < 0:
        raise ValueError(f"max_diff_ns is {max_diff_ns}; it must not be negative")
    ends = (*estimate.stamps_ns[:1], *estimate.stamps_ns[-1:])  # none of an empty one
    # Differences of such stamps still fit into 64 bits; NumPy would wrap around.
    if offset_ns and any(abs(int(end) + offset_ns) >= 2**62 for end in ends):
        raise ValueError(
            f"offset_ns is {offset_ns}; it moves the estimate more than 146 years away from 1970"
        )
    first, second = reference.stamps_ns, estimate.stamps_ns + offset_ns
    _check_units(first, second)
    if len(first) < len(second):
        rows = _nearest(first, second)
        kept = np.abs(second[rows] - first) <= max_diff_ns
        pairs = np.flatnonzero(kept), rows[kept]
    else:
        rows = _nearest(second, first)
        kept = np.abs(first[rows] - second) <= max_diff_ns
        pairs = rows[kept], np.flatnonzero(kept)
    if not len(pairs[0]):
        raise ValueError(_no_pairs(first, second, max_diff_ns, offset_ns))
    return pairs


def _check_units(first: NDArray[np.int64], second: NDArray[np.int64]) -> None:
    """Refuse the stamps of one trajectory in seconds, and of the other in nanoseconds."""
    if len(first) < 2 or len(second) < 2:
        return
    pauses = float(np.median(np.diff(first))), float(np.median(np.diff(second)))
    if min(pauses) < _SHORTEST_PAUSE_NS and max(pauses) > _SHORTEST_PAUSE_NS**2:
        which = "reference" if pauses[0] < pauses[1] else "estimate"
        raise ValueError(
            f"the poses of the {which} are {min(pauses):g} ns apart, those of the other "
            f"{max(pauses):g} ns: stamps are nanoseconds; for integer seconds, write "
            "seconds * 10**9"
        )


def _nearest(few: NDArray[np.int64], many: NDArray[np.int64]) -> NDArray[np.intp]:
    """Return the row of the nearest of ``many`` for each of ``few``; of ties, the earlier one."""
    if not len(many):
        raise ValueError("a trajectory without poses cannot be compared")
    after = np.clip(np.searchsorted(many, few), 1, max(1, len(many) - 1))
    before = after - 1
    after = np.minimum(after, len(many) - 1)
    return np.where(few - many[before] <= many[after] - few, before, after)


def _no_pairs(
    first: NDArray[np.int64], second: NDArray[np.int64], max_diff_ns: int, offset_ns: int
) -> str:
    def span(stamps: NDArray[np.int64]) -> str:
        return f"{stamps[0] / 1e9:.3f} to {stamps[-1] / 1e9:.3f} s" if len(stamps) else "nothing"

    text = (
        f"no stamps of the two trajectories are within {max_diff_ns / 1e9} s: the reference covers "
        f"{span(first)}, the estimate {span(second)}"
    )
    if len(first) and len(second):
        offset = (first[0] - second[0] + offset_ns) / 1e9  # second is moved by offset_ns already
        text += f"; an offset of {offset:.3f} s makes them begin together"
    return text


def align(reference: Trajectory, estimate: Trajectory, how: AlignmentName) -> Alignment:
    """Return the transform that brings the estimate onto the reference.

    Args:
        reference: The reference.
        estimate: The estimate; row i belongs to row i of the reference.
        how: ``none``; ``origin``: the first poses coincide; ``yaw``: least squares over translation
            and rotation about z, for estimates that know where down is; ``se3``: least squares over
            translation and rotation; ``sim3``: and scale.

    Raises:
        ValueError: Another name, or positions that leave the rotation open (``se3``, ``sim3``: all
            on a line or in one place).
    """
    if how == "none":
        return Alignment(np.array((0.0, 0.0, 0.0, 1.0)), np.zeros(3), 1.0)
    if how == "origin":
        rotation = arrays.multiply(reference.rotations[0], arrays.conjugate(estimate.rotations[0]))
        moved = arrays.rotate(rotation, estimate.positions[0])
        return Alignment(rotation, reference.positions[0] - moved, 1.0)
    if how == "yaw":
        return _align_yaw(estimate.positions, reference.positions)
    if how in ("se3", "sim3"):
        return _umeyama(estimate.positions, reference.positions, with_scale=how == "sim3")
    raise ValueError(f"unknown alignment '{how}'; choose from {', '.join(ALIGNMENTS)}")


def _align_yaw(x: NDArray[np.float64], y: NDArray[np.float64]) -> Alignment:
    mean_x, mean_y = x.mean(axis=0), y.mean(axis=0)
    a, b = x - mean_x, y - mean_y
    sine = float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))
    cosine = float(np.sum(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]))
    yaw = np.arctan2(sine, cosine)
    rotation = np.array((0.0, 0.0, np.sin(yaw / 2), np.cos(yaw / 2)))
    return Alignment(rotation, mean_y - arrays.rotate(rotation, mean_x), 1.0)


def _umeyama(x: NDArray[np.float64], y: NDArray[np.float64], *, with_scale: bool) -> Alignment:
    mean_x, mean_y = x.mean(axis=0), y.mean(axis=0)
    a, b = x - mean_x, y - mean_y
    covariance = b.T @ a / len(x)
    u, d, vt = np.linalg.svd(covariance)
    if np.count_nonzero(d > np.finfo(np.float64).eps) < 2:
        raise ValueError(
            "Degenerate covariance rank, Umeyama alignment is not possible: the positions are on "
            "a line or in one point; 'none', 'origin' and 'yaw' align them"
        )
    signs = np.array((1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(vt))))
    rotation = arrays.from_matrices(u @ np.diag(signs) @ vt)
    scale = float(np.sum(d * signs) / (np.sum(a * a) / len(x))) if with_scale else 1.0
    return Alignment(rotation, mean_y - scale * arrays.rotate(rotation, mean_x), scale)
