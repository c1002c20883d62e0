"""A transform on plain floats, applied to points, vectors, rotations and twists."""

from __future__ import annotations

import math
from typing import Any, TypeAlias

__all__ = ["NO_LENGTH", "Motion", "Numbers3", "Numbers4", "unit_quaternion"]

Numbers3: TypeAlias = "tuple[float, float, float]"
Numbers4: TypeAlias = "tuple[float, float, float, float]"

#: tf2 takes a quaternion whose squared length is below this for no rotation.
NO_LENGTH = 2.220446049250313e-16


class Motion:
    """``target_from_source`` of a message, ready to be applied many times.

    The quaternion is normalised first; one without length counts as no rotation, as in ROS 2.

    Args:
        transform: ``geometry_msgs.msg.TransformStamped`` or ``Transform``.

    Attributes:
        translation: x, y, z in metres.
        quaternion: x, y, z, w of unit length.
        rows: The rotation matrix, its nine numbers row by row.
    """

    __slots__ = ("quaternion", "rows", "translation")

    def __init__(self, transform: Any) -> None:
        transform = getattr(transform, "transform", transform)
        t = transform.translation
        self.translation: Numbers3 = (t.x, t.y, t.z)
        x, y, z, w = self.quaternion = unit_quaternion(transform.rotation)
        self.rows = (
            1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),
            2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
            2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y),
        )  # fmt: skip

    def vector(self, v: Any) -> Numbers3:
        """Return a free vector (anything with x, y, z): turned, not moved."""
        a, b, c, d, e, f, g, h, i = self.rows
        x, y, z = v.x, v.y, v.z
        return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z

    def point(self, p: Any) -> Numbers3:
        """Return a point (anything with x, y, z): turned, and moved."""
        a, b, c, d, e, f, g, h, i = self.rows
        x, y, z = p.x, p.y, p.z
        tx, ty, tz = self.translation
        return a * x + b * y + c * z + tx, d * x + e * y + f * z + ty, g * x + h * y + i * z + tz

    def orientation(self, q: Any) -> Numbers4:
        """Return an orientation (anything with x, y, z, w), as a unit quaternion with w >= 0."""
        x, y, z, w = self.quaternion
        i, j, k, r = unit_quaternion(q)
        qx, qy, qz = (
            w * i + x * r + y * k - z * j,
            w * j - x * k + y * r + z * i,
            w * k + x * j - y * i + z * r,
        )
        qw = w * r - x * i - y * j - z * k
        return (qx, qy, qz, qw) if qw >= 0.0 else (-qx, -qy, -qz, -qw)

    def moment(self, about_origin: Any, free: Any) -> Numbers3:
        """Return the part that depends on the point of reference: ``R m + t x (R f)``.

        A torque with its force, or a velocity with its angular velocity: both are stated for the
        origin of their frame, and the origin of the target is another point of the same body.
        """
        mx, my, mz = self.vector(about_origin)
        fx, fy, fz = self.vector(free)
        tx, ty, tz = self.translation
        return mx + ty * fz - tz * fy, my + tz * fx - tx * fz, mz + tx * fy - ty * fx


def unit_quaternion(q: Any) -> Numbers4:
    """x, y, z, w of a quaternion message, of unit length."""
    x, y, z, w = q.x, q.y, q.z, q.w
    squared = x * x + y * y + z * z + w * w
    if squared < NO_LENGTH:
        return 0.0, 0.0, 0.0, 1.0
    scale = 1.0 / math.sqrt(squared)
    return x * scale, y * scale, z * scale, w * scale
