"""What a joint does at a given position, as numbers: the pose of its child in its parent.

A rotation about the unit axis ``a`` by the angle ``q`` after the origin's rotation ``r`` is
``cos(q/2) r + sin(q/2) (r * a)``, with ``a`` as a quaternion. A translation by ``q`` is that of the
origin plus ``q`` times the turned axis.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.urdf.model import Joint, Vector

__all__ = ["NUMBER_OF_CONSTANTS", "joint_constants", "quaternion_from_rpy", "unit_axis"]

NUMBER_OF_CONSTANTS = 15


def quaternion_from_rpy(rpy: Vector) -> tuple[float, float, float, float]:
    """Return the unit quaternion x y z w of roll, pitch and yaw about fixed axes, in radians."""
    roll, pitch, yaw = (angle / 2.0 for angle in rpy)
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), math.cos(pitch)
    sy, cy = math.sin(yaw), math.cos(yaw)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def unit_axis(axis: Vector) -> Vector:
    """Return the axis with length 1; the parser has refused axes of length 0."""
    largest = max(abs(part) for part in axis)  # so that squares neither vanish nor overflow
    x, y, z = (part / largest for part in axis)
    length = math.sqrt(x * x + y * y + z * z)
    return (x / length, y / length, z / length)


def joint_constants(joint: Joint) -> tuple[float, ...]:
    """Return the 15 numbers that make the transform of a joint out of its position q.

    Translation at 0, and its change by q; the quaternion x y z w that cos(q/2) multiplies, and the
    one that sin(q/2) multiplies; 1 if the joint turns, else 0. Joints that are neither revolute nor
    continuous nor prismatic do not move.
    """
    rotation = quaternion_from_rpy(joint.origin.rpy)
    change, turned, turns = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), 0.0
    if joint.type == "prismatic":
        change = _rotated(rotation, unit_axis(joint.axis))
    elif joint.moves:
        turned, turns = _times_axis(rotation, unit_axis(joint.axis)), 1.0
    return (*joint.origin.xyz, *change, *rotation, *turned, turns)


def _times_axis(
    rotation: tuple[float, float, float, float], axis: Vector
) -> tuple[float, float, float, float]:
    """Return the product of a quaternion and a vector, which is a quaternion with w = 0."""
    a, b, c, d = rotation
    x, y, z = axis
    return (
        d * x + b * z - c * y,
        d * y - a * z + c * x,
        d * z + a * y - b * x,
        -a * x - b * y - c * z,
    )


def _rotated(rotation: tuple[float, float, float, float], vector: Vector) -> Vector:
    x, y, z, w = _times_axis(rotation, vector)
    a, b, c, d = rotation
    # (x y z w) times the conjugate of the rotation, without its w, which is 0.
    return (
        -w * a + x * d - y * c + z * b,
        -w * b + x * c + y * d - z * a,
        -w * c - x * b + y * a + z * d,
    )
