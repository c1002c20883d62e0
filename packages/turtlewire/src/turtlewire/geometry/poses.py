"""tf2's arithmetic of poses: plain tuples ``(x, y, z, qx, qy, qz, qw)``.

A pose is named ``parent_from_child``.
"""

from __future__ import annotations

import math
from typing import TypeAlias

Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
Pose: TypeAlias = tuple[float, float, float, float, float, float, float]

IDENTITY: Pose = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the rotation that does ``b`` first, then ``a``."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by + ay * bw + az * bx - ax * bz,
        aw * bz + az * bw + ax * by - ay * bx,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(q: Quaternion) -> Quaternion:
    """Return the opposite rotation of a unit quaternion."""
    return (-q[0], -q[1], -q[2], q[3])


def rotate(q: Quaternion, v: Vector) -> Vector:
    """``v`` turned by the unit quaternion ``q``."""
    x, y, z, w = q
    vx, vy, vz = v
    tx, ty, tz = 2.0 * (y * vz - z * vy), 2.0 * (z * vx - x * vz), 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + (y * tz - z * ty),
        vy + w * ty + (z * tx - x * tz),
        vz + w * tz + (x * ty - y * tx),
    )


def compose(a: Pose, b: Pose) -> Pose:
    """``a_from_b`` and ``b_from_c`` make ``a_from_c``."""
    x, y, z = rotate(a[3:], b[:3])
    return (a[0] + x, a[1] + y, a[2] + z, *multiply(a[3:], b[3:]))


def between(a: Pose, b: Pose) -> Pose:
    """``top_from_a`` and ``top_from_b`` make ``a_from_b``."""
    back = conjugate(a[3:])
    return (*rotate(back, (b[0] - a[0], b[1] - a[1], b[2] - a[2])), *multiply(back, b[3:]))


def canonical(pose: Pose) -> Pose:
    """Return the pose with its quaternion converted to a rotation matrix and back.

    tf2 does so with every result, which fixes the sign and the last bits of the quaternion.
    """
    return (*pose[:3], *through_matrix(pose[3:]))


def through_matrix(q: Quaternion) -> Quaternion:
    """Return a quaternion of any length as tf2 stores it: by way of the 3x3 matrix.

    The result is unit, and one of ``q`` and ``-q`` was chosen: the one whose ``w`` is positive if
    the trace is, else the one whose largest of ``x, y, z`` is. A length beyond the range of floats
    gives the identity, a length of zero gives NaN.
    """
    x, y, z, w = q
    length2 = x * x + y * y + z * z + w * w
    if length2 == 0.0:
        return (math.nan, math.nan, math.nan, math.nan)
    s = 2.0 / length2
    xs, ys, zs = x * s, y * s, z * s
    wx, wy, wz = w * xs, w * ys, w * zs
    xx, xy, xz = x * xs, x * ys, x * zs
    yy, yz, zz = y * ys, y * zs, z * zs
    m00, m11, m22 = 1.0 - (yy + zz), 1.0 - (xx + zz), 1.0 - (xx + yy)
    trace = m00 + m11 + m22
    if math.isnan(trace):
        return (math.nan, math.nan, math.nan, math.nan)
    # Sums and differences of opposite elements: twice the products, rounded as tf2 rounds them.
    x_w, y_w, z_w = (yz + wx) - (yz - wx), (xz + wy) - (xz - wy), (xy + wz) - (xy - wz)
    if trace > 0.0:
        root = math.sqrt(trace + 1.0)
        f = 0.5 / root
        return (x_w * f, y_w * f, z_w * f, root * 0.5)
    x_y, y_z, z_x = (xy + wz) + (xy - wz), (yz + wx) + (yz - wx), (xz - wy) + (xz + wy)
    if m00 >= m11 and m00 >= m22:
        root = math.sqrt(m00 - m11 - m22 + 1.0)
        f = 0.5 / root
        return (root * 0.5, x_y * f, z_x * f, x_w * f)
    if m11 >= m22:
        root = math.sqrt(m11 - m22 - m00 + 1.0)
        f = 0.5 / root
        return (x_y * f, root * 0.5, y_z * f, y_w * f)
    root = math.sqrt(m22 - m00 - m11 + 1.0)
    f = 0.5 / root
    return (z_x * f, y_z * f, root * 0.5, z_w * f)


def interpolate(older: Pose, newer: Pose, ratio: float) -> Pose:
    """The pose a part ``ratio`` (0 to 1) of the way: a straight line, and the shortest arc."""
    back = 1.0 - ratio
    cosine = sum(a * b for a, b in zip(older[3:], newer[3:], strict=True))
    angle = math.acos(min(abs(cosine), 1.0))
    if angle < 1e-8:  # the arc is a straight line to the last bit
        keep, take = back, ratio
    else:
        scale = 1.0 / math.sin(angle)
        keep, take = math.sin(back * angle) * scale, math.sin(ratio * angle) * scale
    if cosine < 0.0:
        take = -take
    ox, oy, oz, oqx, oqy, oqz, oqw = older
    nx, ny, nz, nqx, nqy, nqz, nqw = newer
    return (
        back * ox + ratio * nx,
        back * oy + ratio * ny,
        back * oz + ratio * nz,
        keep * oqx + take * nqx,
        keep * oqy + take * nqy,
        keep * oqz + take * nqz,
        keep * oqw + take * nqw,
    )
