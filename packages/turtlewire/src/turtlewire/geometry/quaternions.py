"""The arithmetic of one quaternion ``(x, y, z, w)``, on plain floats."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import NDArray

    #: Numbers, one after the other; an array has the shape ``(n,)``.
    Numbers: TypeAlias = Sequence[float] | NDArray[Any]

__all__ = [
    "Matrix",
    "Quaternion",
    "Vector",
    "conjugate",
    "from_matrix",
    "from_rpy",
    "matrix",
    "multiply",
    "rotate",
    "rotate_scaling",
    "through_matrix",
    "to_rpy",
]

Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
Matrix: TypeAlias = tuple[float, float, float, float, float, float, float, float, float]
"""A 3x3 matrix, row by row."""

_NO_NUMBERS: Quaternion = (math.nan, math.nan, math.nan, math.nan)


def multiply(quaternion1: Numbers, quaternion0: Numbers) -> Quaternion:
    """Return the Hamilton product: the rotation ``quaternion0``, followed by ``quaternion1``."""
    # ROS 2's names of the parameters: the function is also tf_transformations.quaternion_multiply.
    ax, ay, az, aw = quaternion1
    bx, by, bz, bw = quaternion0
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by + ay * bw + az * bx - ax * bz,
        aw * bz + az * bw + ax * by - ay * bx,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(q: Numbers) -> Quaternion:
    """Return the opposite rotation."""
    return (-q[0], -q[1], -q[2], q[3])


def rotate(q: Quaternion, v: Vector) -> Vector:
    """Return the vector ``v``, turned by ``q``."""
    x, y, z, w = q
    vx, vy, vz = v
    tx, ty, tz = 2.0 * (y * vz - z * vy), 2.0 * (z * vx - x * vz), 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + (y * tz - z * ty),
        vy + w * ty + (z * tx - x * tz),
        vz + w * tz + (x * ty - y * tx),
    )


def rotate_scaling(q: Quaternion, v: Vector) -> Vector:
    """Return ``q v q*``, for a quaternion of any length: it scales by the length's square."""
    longer = sum(number * number for number in q) - 1.0
    x, y, z = rotate(q, v)
    return (x + longer * v[0], y + longer * v[1], z + longer * v[2])


def from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Return the rotation by ``roll``, ``pitch`` and ``yaw`` [rad] about fixed axes x, y and z."""
    sr, cr = math.sin(roll / 2.0), math.cos(roll / 2.0)
    sp, cp = math.sin(pitch / 2.0), math.cos(pitch / 2.0)
    sy, cy = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def to_rpy(q: Quaternion) -> Vector:
    """Return roll, pitch and yaw [rad] about fixed axes of a unit quaternion."""
    x, y, z, w = q
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return roll, pitch, yaw


def matrix(q: Numbers) -> Matrix:
    """Return the rotation matrix of a quaternion of any length but zero.

    Raises:
        ZeroDivisionError: The quaternion has no length.
    """
    x, y, z, w = q
    s = 2.0 / (x * x + y * y + z * z + w * w)
    xs, ys, zs = x * s, y * s, z * s
    wx, wy, wz = w * xs, w * ys, w * zs
    xx, xy, xz = x * xs, x * ys, x * zs
    yy, yz, zz = y * ys, y * zs, z * zs
    return (
        1.0 - (yy + zz), xy - wz, xz + wy,
        xy + wz, 1.0 - (xx + zz), yz - wx,
        xz - wy, yz + wx, 1.0 - (xx + yy),
    )  # fmt: skip


def from_matrix(rows: Matrix) -> Quaternion:
    """Return the quaternion of a rotation matrix, with the sign that tf2 gives it.

    ``w`` is positive if the trace is; else the largest of ``x, y, z`` is.
    """
    m00, m01, m02, m10, m11, m12, m20, m21, m22 = rows
    trace = m00 + m11 + m22
    if math.isnan(trace):
        return _NO_NUMBERS
    if trace > 0.0:
        root = math.sqrt(trace + 1.0)
        f = 0.5 / root
        return ((m21 - m12) * f, (m02 - m20) * f, (m10 - m01) * f, root * 0.5)
    if m00 >= m11 and m00 >= m22:
        root = math.sqrt(m00 - m11 - m22 + 1.0)
        f = 0.5 / root
        return (root * 0.5, (m10 + m01) * f, (m20 + m02) * f, (m21 - m12) * f)
    if m11 >= m22:
        root = math.sqrt(m11 - m22 - m00 + 1.0)
        f = 0.5 / root
        return ((m10 + m01) * f, root * 0.5, (m21 + m12) * f, (m02 - m20) * f)
    root = math.sqrt(m22 - m00 - m11 + 1.0)
    f = 0.5 / root
    return ((m20 + m02) * f, (m21 + m12) * f, root * 0.5, (m10 - m01) * f)


def through_matrix(q: Quaternion) -> Quaternion:
    """Return a quaternion of any length as tf2 stores it: converted to a matrix and back.

    The result is unit, and its sign and last bits are tf2's. A length beyond the range of floats
    gives the identity, a length of zero gives NaN.
    """
    try:
        return from_matrix(matrix(q))
    except ZeroDivisionError:
        return _NO_NUMBERS
