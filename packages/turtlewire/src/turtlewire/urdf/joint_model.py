"""The transform of a joint at a given position: the pose of its child in its parent.

A rotation about the unit axis ``a`` by the angle ``q`` after the origin's rotation ``r`` is
``cos(q/2) r + sin(q/2) (r * a)``, with ``a`` as a quaternion. A translation by ``q`` is that of the
origin plus ``q`` times the turned axis.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from turtlewire.geometry import quaternions

if TYPE_CHECKING:
    from turtlewire.urdf.model import Joint, Vector

__all__ = ["NUMBER_OF_CONSTANTS", "joint_constants", "unit_axis"]

NUMBER_OF_CONSTANTS = 15


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
    rotation = joint.origin.quaternion
    change, turned, turns = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), 0.0
    if joint.type == "prismatic":
        change = quaternions.rotate(rotation, unit_axis(joint.axis))
    elif joint.moves:
        turned = quaternions.multiply(rotation, (*unit_axis(joint.axis), 0.0))
        turns = 1.0
    return (*joint.origin.xyz, *change, *rotation, *turned, turns)
