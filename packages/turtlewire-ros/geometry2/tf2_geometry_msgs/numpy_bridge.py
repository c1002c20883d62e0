"""Messages of geometry_msgs as NumPy arrays, and back: ``X_from_Y`` makes an X of a Y.

An *array* has the numbers in the order of the fields: a point ``x, y, z``, a quaternion ``x, y, z,
w``, a pose ``x, y, z, qx, qy, qz, qw``. A *matrix* is ``(4, 4)`` and acts on column vectors from
the left: ``matrix_from_transform(t) @ (x, y, z, 1)`` does what ``do_transform_point`` does. *Euler*
angles are radians; ``axes`` names the convention, see :mod:`turtlewire.geometry`, which has
all of this for plain arrays of any shape.

Arrays are of double precision, and never share memory with a message. Wrong shapes raise
ValueError.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry_msgs.msg import Point, Pose, Quaternion, Transform, Vector3
from turtlewire import geometry

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]


def array_from_point(point: Point | Any) -> Array:
    """Convert a Point or Point32 to shape ``(3,)``."""
    return np.array((point.x, point.y, point.z), dtype=np.float64)


def point_from_array(array: ArrayLike) -> Point:
    """Return a Point of three numbers."""
    x, y, z = _numbers(array, 3, "a point")
    return Point(x=x, y=y, z=z)


def array_from_points(points: Iterable[Point | Any]) -> Array:
    """Convert Points, Point32s or Vector3s, for example a polygon's, to shape ``(N, 3)``."""
    # The shape also holds without points, when the list has no second axis.
    return np.array([(p.x, p.y, p.z) for p in points], dtype=np.float64).reshape(-1, 3)


def points_from_array(array: ArrayLike) -> list[Point]:
    """Return the Points of an array of shape ``(N, 3)``."""
    return [Point(x=x, y=y, z=z) for x, y, z in _rows(array, 3, "points")]


def array_from_vector3(vector3: Vector3) -> Array:
    """Convert a Vector3 to shape ``(3,)``."""
    return np.array((vector3.x, vector3.y, vector3.z), dtype=np.float64)


def vector3_from_array(array: ArrayLike) -> Vector3:
    """Return a Vector3 of three numbers."""
    x, y, z = _numbers(array, 3, "a vector")
    return Vector3(x=x, y=y, z=z)


def array_from_quaternion(quaternion: Quaternion) -> Array:
    """Convert a Quaternion to shape ``(4,)``: x, y, z, w as they are."""
    return np.array((quaternion.x, quaternion.y, quaternion.z, quaternion.w), dtype=np.float64)


def quaternion_from_array(array: ArrayLike) -> Quaternion:
    """Return a Quaternion of the four numbers x, y, z, w as they are."""
    x, y, z, w = _numbers(array, 4, "a quaternion")
    return Quaternion(x=x, y=y, z=z, w=w)


def euler_from_quaternion(quaternion: Quaternion, axes: str = "sxyz") -> Array:
    """Return three angles in the order that ``axes`` names.

    By default these are roll, pitch and yaw about static axes.
    """
    return geometry.euler_from_quaternion(array_from_quaternion(quaternion), axes)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Quaternion:
    """Return a Quaternion of three angles in the order that ``axes`` names.

    By default these are roll, pitch and yaw about static axes.
    """
    return quaternion_from_array(geometry.quaternion_from_euler((ai, aj, ak), axes))


def array_from_pose(pose: Pose) -> Array:
    """Convert a Pose to shape ``(7,)``."""
    return np.array(_pose_numbers(pose), dtype=np.float64)


def pose_from_array(array: ArrayLike) -> Pose:
    """Return a Pose of seven numbers."""
    return _pose(_numbers(array, 7, "a pose"))


def array_from_poses(poses: Iterable[Pose]) -> Array:
    """Convert Poses, for example of a PoseArray, to shape ``(N, 7)``."""
    return np.array([_pose_numbers(pose) for pose in poses], dtype=np.float64).reshape(-1, 7)


def poses_from_array(array: ArrayLike) -> list[Pose]:
    """Return the poses of an array of shape ``(N, 7)``."""
    return [_pose(numbers) for numbers in _rows(array, 7, "poses")]


def matrix_from_pose(pose: Pose) -> Array:
    """Return the homogeneous matrix of a Pose, of shape ``(4, 4)``.

    It takes coordinates in the pose's own frame to the frame of its header.
    """
    return geometry.matrix_from_pose(array_from_pose(pose))


def pose_from_matrix(matrix: ArrayLike) -> Pose:
    """Return the Pose of a homogeneous matrix."""
    return pose_from_array(geometry.pose_from_matrix(matrix))


def array_from_transform(transform: Transform | Any) -> Array:
    """Convert a Transform or TransformStamped to shape ``(7,)``."""
    transform = getattr(transform, "transform", transform)
    return np.concatenate(
        (array_from_vector3(transform.translation), array_from_quaternion(transform.rotation))
    )


def transform_from_array(array: ArrayLike) -> Transform:
    """Return a Transform of seven numbers."""
    x, y, z, qx, qy, qz, qw = _numbers(array, 7, "a transform")
    return Transform(
        translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)
    )


def matrix_from_transform(transform: Transform | Any) -> Array:
    """Return target_from_source, of shape ``(4, 4)``, of a Transform or TransformStamped."""
    return geometry.matrix_from_pose(array_from_transform(transform))


def transform_from_matrix(matrix: ArrayLike) -> Transform:
    """Return the Transform of a homogeneous matrix."""
    return transform_from_array(geometry.pose_from_matrix(matrix))


def _numbers(array: ArrayLike, count: int, what: str) -> list[float]:
    numbers = np.asarray(array, dtype=np.float64)
    if numbers.shape != (count,):
        raise ValueError(f"{what} has the shape ({count},), got {numbers.shape}")
    listed: list[float] = numbers.tolist()
    return listed


def _rows(array: ArrayLike, count: int, what: str) -> list[list[float]]:
    rows = np.asarray(array, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != count:
        raise ValueError(f"{what} have the shape (N, {count}), got {rows.shape}")
    listed: list[list[float]] = rows.tolist()
    return listed


def _pose_numbers(pose: Pose) -> tuple[float, ...]:
    p, q = pose.position, pose.orientation
    return p.x, p.y, p.z, q.x, q.y, q.z, q.w


def _pose(numbers: list[float]) -> Pose:
    x, y, z, qx, qy, qz, qw = numbers
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))
