"""A transform on plain floats, applied to points, vectors, rotations and twists."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from turtlewire.geometry.quaternions import matrix, multiply

if TYPE_CHECKING:
    from turtlewire.geometry.quaternions import Quaternion, Vector

#: The epsilon of doubles. tf2 treats a quaternion whose squared length is below it as no rotation.
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
        self.translation: Vector = (t.x, t.y, t.z)
        self.quaternion = unit_quaternion(transform.rotation)
        self.rows = matrix(self.quaternion)

    def vector(self, v: Any) -> Vector:
        """Return a free vector (anything with x, y, z): turned, not moved."""
        a, b, c, d, e, f, g, h, i = self.rows
        x, y, z = v.x, v.y, v.z
        return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z

    def point(self, p: Any) -> Vector:
        """Return a point (anything with x, y, z): turned, and moved."""
        a, b, c, d, e, f, g, h, i = self.rows
        x, y, z = p.x, p.y, p.z
        tx, ty, tz = self.translation
        return a * x + b * y + c * z + tx, d * x + e * y + f * z + ty, g * x + h * y + i * z + tz

    def orientation(self, q: Any) -> Quaternion:
        """Return an orientation (anything with x, y, z, w), as a unit quaternion with w >= 0."""
        x, y, z, w = q.x, q.y, q.z, q.w
        squared = x * x + y * y + z * z + w * w
        if squared < NO_LENGTH:
            x, y, z, w, squared = 0.0, 0.0, 0.0, 1.0, 1.0
        x, y, z, w = multiply(self.quaternion, (x, y, z, w))
        # q and -q are the same rotation. One scaling makes the length 1 and w positive.
        scale = (1.0 if w >= 0.0 else -1.0) / math.sqrt(squared)
        return x * scale, y * scale, z * scale, w * scale

    def moment(self, about_origin: Any, free: Any) -> Vector:
        """Return the part that depends on the point of reference: ``R m + t x (R f)``.

        A torque with its force, or a velocity with its angular velocity: both are stated for the
        origin of their frame, and the origin of the target is another point of the same body.
        """
        mx, my, mz = self.vector(about_origin)
        fx, fy, fz = self.vector(free)
        tx, ty, tz = self.translation
        return mx + ty * fz - tz * fy, my + tz * fx - tx * fz, mz + tx * fy - ty * fx


def unit_quaternion(q: Any) -> Quaternion:
    """Return x, y, z, w of a quaternion message, with unit length."""
    x, y, z, w = q.x, q.y, q.z, q.w
    squared = x * x + y * y + z * z + w * w
    if squared < NO_LENGTH:
        return 0.0, 0.0, 0.0, 1.0
    scale = 1.0 / math.sqrt(squared)
    return x * scale, y * scale, z * scale, w * scale
