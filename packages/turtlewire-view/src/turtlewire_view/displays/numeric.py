"""Poses, points and colours of messages as arrays: finite, and exact far from the origin."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire_view.displays.content import UnusableMessageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.displays.content import Vector

__all__ = [
    "LARGEST",
    "anchored",
    "color_bytes",
    "finite_points",
    "finite_pose",
    "picked_rows",
    "points_of",
    "pose_rows",
    "rgba_bytes",
    "rows_within",
    "spread",
    "warn_of_quaternions",
]

#: 32-bit coordinates are exact to a millimetre up to here [m].
_EXACT_BELOW = 8192.0
#: Beyond this a length is nonsense, and 32-bit numbers overflow in the page's products.
LARGEST = 1e9
_SHORTEST_QUATERNION = 1e-9
#: How far the square of a quaternion's length may be from 1, in RViz as well.
_NORMALIZED_WITHIN = 0.01


def finite_pose(pose: Any, warn: Callable[[str], None]) -> list[float]:
    """x, y, z, qx, qy, qz, qw of a Pose message, the quaternion of unit length.

    As in RViz a quaternion of zeros means no rotation.

    Args:
        pose: The message.
        warn: Gets what is wrong with the quaternion.

    Raises:
        UnusableMessageError: A number is not finite, or absurdly large.
    """
    at, turn = pose.position, pose.orientation
    given = [(at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w)]
    rows, kept = pose_rows(given)
    if not kept[0]:
        raise UnusableMessageError(
            f"the pose holds a number that is not finite or too large: position ({at.x}, {at.y}, "
            f"{at.z}), orientation ({turn.x}, {turn.y}, {turn.z}, {turn.w})"
        )
    warn_of_quaternions(given, warn)
    return [float(value) for value in rows[0]]


def warn_of_quaternions(rows: Sequence[tuple[float, ...]], warn: Callable[[str], None]) -> None:
    """Say which quaternions of poses (x, y, z, then xyzw) are not rotations, as RViz does."""
    poses = np.array(rows, dtype=np.float64).reshape(-1, 7)
    lengths = np.linalg.norm(poses[rows_within(poses), 3:], axis=1)
    none = lengths < _SHORTEST_QUATERNION
    scaled = (np.abs(lengths**2 - 1.0) > _NORMALIZED_WITHIN) & ~none
    for which, text in (
        (none, "Uninitialized quaternion, assuming identity."),
        (scaled, "Unnormalized quaternion, drawn with length 1."),
    ):
        count = int(np.count_nonzero(which))
        if count:
            warn(text if len(rows) == 1 else f"{text} ({count} of {len(rows)} poses)")


def pose_rows(
    rows: Sequence[tuple[float, ...]],
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Poses as ``(n, 7)`` with unit quaternions (xyzw), without those that are not finite.

    Returns:
        The poses that are left, and for each given one whether it is.
    """
    poses = np.array(rows, dtype=np.float64).reshape(-1, 7)
    kept = rows_within(poses)
    poses = poses[kept]
    lengths = np.linalg.norm(poses[:, 3:], axis=1)
    none = lengths < _SHORTEST_QUATERNION
    poses[none, 3:] = (0.0, 0.0, 0.0, 1.0)
    poses[~none, 3:] /= lengths[~none, None]
    return poses, kept


def rows_within(rows: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return for each row if all its numbers are finite and smaller than ``LARGEST``."""
    with np.errstate(invalid="ignore"):
        within: NDArray[np.bool_] = np.all(np.abs(rows) < LARGEST, axis=1)  # also false for NaN
    return within


def picked_rows(values: Any, picked: NDArray[np.intp], names: str) -> NDArray[np.float64]:
    """Some of a sequence of plain messages, ``(n, numbers of each)``.

    Args:
        values: The messages, or all as rows (see :func:`turtlewire.msg.deserialize`).
        picked: Which of them.
        names: The letters that are the messages' fields.
    """
    if isinstance(values, np.ndarray):
        return values[picked].astype(np.float64)
    numbers = [[getattr(values[at], name) for name in names] for at in picked]
    return np.array(numbers, dtype=np.float64).reshape(-1, len(names))


def points_of(points: Sequence[Any]) -> NDArray[np.float64]:
    """x, y, z of Point messages as ``(n, 3)``; what is not finite or absurdly large is NaN."""
    return finite_points(picked_rows(points, np.arange(len(points)), "xyz"))


def finite_points(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rows of numbers, whose numbers that are not finite or absurdly large become NaN."""
    with np.errstate(invalid="ignore"):
        array[~(np.abs(array) < LARGEST)] = math.nan
    return array


def anchored(points: NDArray[np.float64]) -> tuple[NDArray[np.float32], Vector]:
    """Points ``(n, 3)`` as 32-bit numbers relative to an anchor, and the anchor.

    The anchor is the origin unless 32-bit coordinates would be coarser than a millimetre there.
    """
    if not len(points) or np.abs(points).max() < _EXACT_BELOW:
        return points.astype(np.float32), (0.0, 0.0, 0.0)
    x, y, z = (float(value) for value in np.round((points.min(axis=0) + points.max(axis=0)) / 2))
    return (points - (x, y, z)).astype(np.float32), (x, y, z)


def spread(count: int, budget: int) -> NDArray[np.intp]:
    """Return the indices of at most ``budget`` of ``count`` items, evenly spread."""
    if count <= budget:
        return np.arange(count)
    return np.linspace(0, count - 1, max(1, budget)).astype(np.intp)


def color_bytes(rows: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Colours from 0 to 1, ``(n, 4)``, as bytes."""
    return np.rint(np.clip(np.nan_to_num(rows, nan=0.0), 0.0, 1.0) * 255).astype(np.uint8)


def rgba_bytes(color: Any) -> list[int]:
    """Convert a ColorRGBA message to four bytes."""
    return [int(value) for value in color_bytes(picked_rows([color], np.arange(1), "rgba"))[0]]
