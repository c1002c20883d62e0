"""Poses as NumPy arrays.

The buffer imports NumPy only here, and only when an array is asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from turtlewire.geometry import quaternions

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray


class HasPose(Protocol):
    """A Transform of either core."""

    @property
    def translation(self) -> tuple[float, float, float]:
        """In metres."""
        ...

    @property
    def rotation(self) -> tuple[float, float, float, float]:
        """The unit quaternion x, y, z, w."""
        ...


def pose_array(
    transform: HasPose, dtype: DTypeLike | None = None, copy: bool | None = None
) -> NDArray[Any]:
    """Return the seven numbers ``x, y, z, qx, qy, qz, qw`` of a transform, shape ``(7,)``."""
    if copy is False:
        raise ValueError("a Transform has no array to share; its array is always a copy")
    return np.array((*transform.translation, *transform.rotation), dtype=dtype)


def pose_matrix(transform: HasPose) -> NDArray[np.float64]:
    """Return the homogeneous matrix of a transform, shape ``(4, 4)``.

    It multiplies column vectors from the left.
    """
    rows = quaternions.matrix(transform.rotation)
    matrix = np.eye(4)
    matrix[:3, :3] = (rows[:3], rows[3:6], rows[6:])
    matrix[:3, 3] = transform.translation
    return matrix
