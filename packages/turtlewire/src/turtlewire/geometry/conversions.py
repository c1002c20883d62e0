"""Quaternions, Euler angles, matrices and poses as NumPy arrays: one, or any number at once.

Every function takes arrays with leading axes of any shape and returns new ones of double precision.
Quaternions are ``x, y, z, w``; inputs are normalised first, and results have ``w >= 0``.
Matrices act on column vectors from the left. A pose is ``x, y, z, qx, qy, qz, qw``, as batches of
lookups return it.

Euler angles name their axes by four letters: ``s`` for static axes or ``r`` for axes that turn
along, then the axes in the order in which the angles are applied. ``"sxyz"`` is roll, pitch, yaw;
``"rzyx"`` is the same rotation with the angles in the order yaw, pitch, roll. There are 24 such
conventions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from turtlewire.geometry import arrays

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = [
    "AXES",
    "euler_from_quaternion",
    "matrix_from_pose",
    "matrix_from_quaternion",
    "pose_from_matrix",
    "quaternion_from_euler",
    "quaternion_from_matrix",
]

AXES = tuple(
    frame + i + j + k
    for frame in "sr"
    for i in "xyz"
    for j in "xyz"
    if j != i
    for k in "xyz"
    if k != j
)
"""The names of the 24 conventions of Euler angles."""

#: Nearer to the poles than this, only the sum or the difference of the outer two angles is known.
_POLE = 1e-7


def matrix_from_quaternion(quaternion: ArrayLike) -> Array:
    """Rotation matrices, shape ``(..., 3, 3)``, of quaternions, shape ``(..., 4)``.

    Raises:
        ValueError: The last axis is not 4 long, or a quaternion has no length.
    """
    return arrays.matrices(_unit(quaternion))


def quaternion_from_matrix(matrix: ArrayLike) -> Array:
    """Quaternions, shape ``(..., 4)``, of rotation matrices, shape ``(..., 3, 3)``.

    Scale and shear are not detected.

    Raises:
        ValueError: The last two axes are not 3 by 3.
    """
    return arrays.from_matrices(_shaped(matrix, (3, 3), "rotation matrices"))


def matrix_from_pose(pose: ArrayLike) -> Array:
    """Homogeneous matrices, shape ``(..., 4, 4)``, of poses, shape ``(..., 7)``.

    Raises:
        ValueError: The last axis is not 7 long, or a quaternion has no length.
    """
    p = _shaped(pose, (7,), "poses")
    matrix = np.zeros((*p.shape[:-1], 4, 4))
    matrix[..., :3, :3] = matrix_from_quaternion(p[..., 3:])
    matrix[..., :3, 3] = p[..., :3]
    matrix[..., 3, 3] = 1.0
    return matrix


def pose_from_matrix(matrix: ArrayLike) -> Array:
    """Poses, shape ``(..., 7)``, of homogeneous matrices, shape ``(..., 4, 4)``.

    Raises:
        ValueError: The last two axes are not 4 by 4.
    """
    m = _shaped(matrix, (4, 4), "homogeneous matrices")
    return np.concatenate((m[..., :3, 3], quaternion_from_matrix(m[..., :3, :3])), axis=-1)


def quaternion_from_euler(angles: ArrayLike, axes: str = "sxyz") -> Array:
    """Quaternions, shape ``(..., 4)``, of Euler angles, shape ``(..., 3)``.

    Args:
        angles: In radians, in the order in which ``axes`` names them.
        axes: One of the 24 conventions.

    Raises:
        ValueError: The last axis is not 3 long, or there is no such convention.
    """
    half = 0.5 * _shaped(angles, (3,), "Euler angles")
    static, (i, j, k) = _axes(axes)
    first, second, third = (_about(axis, half[..., n]) for n, axis in enumerate((i, j, k)))
    if static:
        first, third = third, first
    return arrays.upper(arrays.multiply(arrays.multiply(first, second), third))


def euler_from_quaternion(quaternion: ArrayLike, axes: str = "sxyz") -> Array:
    """Euler angles, shape ``(..., 3)``, of quaternions, shape ``(..., 4)``.

    Args:
        quaternion: Of any length but zero.
        axes: One of the 24 conventions.

    Returns:
        Angles in radians, in the order in which ``axes`` names them. The first and third are in
        (-pi, pi]; the second is in [-pi/2, pi/2] where the three axes differ, and in [0, pi] where
        the first and third are the same. In gimbal lock one angle is free: it is 0, the third one
        of static and the first one of turning axes.

    Raises:
        ValueError: The last axis is not 4 long, a quaternion has no length, or there is no such
            convention.
    """
    q = _unit(quaternion)
    static, (i, j, k) = _axes(axes)
    if not static:  # turning axes are static ones in reverse order
        i, k = k, i
    same = i == k
    if same:
        k = 3 - i - j
    sign = 1.0 if (i, j, k) in {(0, 1, 2), (1, 2, 0), (2, 0, 1)} else -1.0
    a, b, c, d = q[..., 3], q[..., i], q[..., j], sign * q[..., k]
    if not same:
        a, b, c, d = a - c, b + d, c + a, d - b
    middle = 2 * np.arctan2(np.hypot(c, d), np.hypot(a, b))
    half_sum, half_difference = np.arctan2(b, a), np.arctan2(d, c)
    first, third = half_sum - half_difference, half_sum + half_difference
    low, high = middle < _POLE, middle > np.pi - _POLE
    first = np.where(low, 2 * half_sum, np.where(high, -2 * half_difference, first))
    third = np.where(low | high, 0.0, third)
    if not same:
        middle, third = middle - np.pi / 2, sign * third
    ordered = (first, middle, third) if static else (third, middle, first)
    return _wrapped(np.stack(ordered, axis=-1))


def _axes(axes: str) -> tuple[bool, tuple[int, int, int]]:
    if axes not in AXES:
        raise ValueError(f"axes is {axes!r}; it can be one of {', '.join(AXES)}")
    i, j, k = ("xyz".index(letter) for letter in axes[1:])
    return axes[0] == "s", (i, j, k)


def _shaped(values: ArrayLike, shape: tuple[int, ...], what: str) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.shape[-len(shape) :] != shape:
        raise ValueError(
            f"{what} have the shape (..., {', '.join(map(str, shape))}), got {array.shape}"
        )
    return array


def _unit(quaternion: ArrayLike) -> Array:
    q = _shaped(quaternion, (4,), "quaternions")
    length = np.sqrt(np.einsum("...i,...i", q, q))[..., None]
    if not np.all(length):
        raise ValueError("a quaternion of length 0 is not a rotation")
    result: Array = q / length
    return result


def _about(axis: int, half_angle: Array) -> Array:
    q = np.zeros((*half_angle.shape, 4))
    q[..., axis] = np.sin(half_angle)
    q[..., 3] = np.cos(half_angle)
    return q


def _wrapped(angles: Array) -> Array:
    turned = np.where(angles > np.pi, angles - 2 * np.pi, angles)
    return np.where(turned <= -np.pi, turned + 2 * np.pi, turned) + 0.0  # no negative zeros
