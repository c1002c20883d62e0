"""What joints do at given positions, as arrays: the transform from a joint's child to its parent.

A rotation about the unit axis ``a`` by the angle ``q`` after the origin's rotation ``r`` is
``cos(q/2) r + sin(q/2) (r * a)``, with ``a`` as a quaternion. A translation by ``q`` is that of the
origin plus ``q`` times the turned axis.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from turtlewire.urdf.model import Joint, Vector

__all__ = ["JointModel", "quaternion_from_rpy", "unit_axis"]


def quaternion_from_rpy(rpy: Vector) -> tuple[float, float, float, float]:
    """The unit quaternion x y z w of roll, pitch and yaw about fixed axes, in radians."""
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
    """The axis with length 1; the parser has refused axes of length 0."""
    largest = max(abs(part) for part in axis)  # so that squares neither vanish nor overflow
    x, y, z = (part / largest for part in axis)
    length = math.sqrt(x * x + y * y + z * z)
    return (x / length, y / length, z / length)


class JointModel:
    """Constants of joints, for their transforms at many positions.

    Attributes:
        constants: (joints, 15) float64, contiguous: translation at 0, its change by position; the
            quaternion x y z w that cos(q/2) multiplies, the one that sin(q/2) multiplies; 1 if the
            joint turns, else 0.
    """

    def __init__(self, joints: Sequence[Joint]) -> None:
        self.constants: NDArray[np.float64] = np.array(
            [_constants(joint) for joint in joints], dtype=np.float64
        ).reshape(len(joints), 15)

    def transforms(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transforms at ``positions`` (N, joints): (N, joints, 7) as x y z and x y z w."""
        half = positions * (0.5 * self.constants[:, 14])
        out = np.empty((*positions.shape, 7))
        out[..., :3] = self.constants[:, :3] + positions[..., None] * self.constants[:, 3:6]
        out[..., 3:] = (
            np.cos(half)[..., None] * self.constants[:, 6:10]
            + np.sin(half)[..., None] * self.constants[:, 10:14]
        )
        return out


def _constants(joint: Joint) -> list[float]:
    rotation = quaternion_from_rpy(joint.origin.rpy)
    change, turned, turns = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), 0.0
    if joint.type == "prismatic":
        change = _rotated(rotation, unit_axis(joint.axis))
    elif joint.moves:
        turned, turns = _times_axis(rotation, unit_axis(joint.axis)), 1.0
    return [*joint.origin.xyz, *change, *rotation, *turned, turns]


def _times_axis(
    rotation: tuple[float, float, float, float], axis: Vector
) -> tuple[float, float, float, float]:
    """The product of a quaternion and a vector, which is a quaternion with w = 0."""
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
