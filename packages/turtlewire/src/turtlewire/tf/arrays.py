"""Poses as NumPy arrays.

The buffer imports NumPy only here, and only when an array is asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from turtlewire.call_errors import frame_error
from turtlewire.geometry import quaternions
from turtlewire.tf.array_arguments import number_array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, DTypeLike, NDArray


class HasPose(Protocol):
    """A Transform of either core."""

    @property
    def translation(self) -> tuple[float, float, float]:
        """The translations, in metres."""
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


def applied(transform: HasPose, points: ArrayLike) -> NDArray[Any]:
    """Return points of the source frame, shape ``(..., 3)``, in the target frame.

    float32 stays float32, all else becomes float64.

    Raises:
        ValueError: The last axis is not 3 long.
    """
    given = number_array(points, "points")
    if given.ndim == 0 or given.shape[-1] != 3:
        raise ValueError(
            f"points must have the shape (..., 3), not {given.shape}{_remedy(given.shape)}"
        )
    matrix = pose_matrix(transform)
    moved: NDArray[Any] = given @ matrix[:3, :3].T + matrix[:3, 3]
    return moved.astype(given.dtype, copy=False)


def _remedy(shape: tuple[int, ...]) -> str:
    """Return what to write instead of points of another shape."""
    if len(shape) == 2 and shape[0] == 3:
        return "; write points.T"
    if len(shape) == 2 and shape[1] > 3:
        return "; write points[:, :3] if the first columns are x, y, z"
    return ""


def euler_angles(transform: HasPose) -> tuple[float, float, float]:
    """Return roll, pitch and yaw of a transform, in radians."""
    from turtlewire.geometry.conversions import euler_from_quaternion

    roll, pitch, yaw = euler_from_quaternion(transform.rotation).tolist()
    return roll, pitch, yaw


def of_matrix(
    cls: Any,
    target_frame: str,
    source_frame: str,
    matrix: ArrayLike,
    stamp_ns: int | None = None,
) -> Any:
    """Return a Transform of class ``cls`` with the pose of a homogeneous matrix."""
    from turtlewire.tf.pose_rows import matrix_row

    for argument, frame in (("target_frame", target_frame), ("source_frame", source_frame)):
        if not isinstance(frame, str):
            raise frame_error(argument, frame)
    row = matrix_row(matrix)
    return cls(target_frame, source_frame, row[:3], row[3:], stamp_ns=stamp_ns)


def reduced(transform: Any) -> tuple[Any, ...]:
    """Return what pickles a Transform of either core."""
    return _restored, (
        type(transform),
        transform.target_frame,
        transform.source_frame,
        transform.translation,
        transform.rotation,
        transform.stamp_ns,
    )


def _restored(cls: Any, *fields: Any) -> Any:
    *pose, stamp_ns = fields
    return cls(*pose, stamp_ns=stamp_ns)
