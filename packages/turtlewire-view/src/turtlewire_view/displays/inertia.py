"""Mass and inertia of a link as bodies, as RViz draws them.

The mass is a ball of lead of that weight. The inertia is the box of even density that has the
link's mass and moments of inertia; a link whose moments no body can have gets none.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.geometry.conversions import matrix_from_quaternion, quaternion_from_matrix

if TYPE_CHECKING:
    from turtlewire.urdf.model import Inertial, Link, Pose

__all__ = ["inertia_shapes", "pose_of_origin"]

#: Density of lead [kg/m^3].
_LEAD = 11340.0
_COLOR = [255, 0, 0, 255]
_LARGEST = 1e9


def inertia_shapes(link: Link) -> dict[str, list[dict[str, Any]]]:
    """``mass`` and ``inertia`` of a link: each a list of one shape, or of none."""
    inertial = link.inertial
    origin = None if inertial is None else pose_of_origin(inertial.origin)
    if inertial is None or origin is None or not 0 < inertial.mass < _LARGEST:
        return {"mass": [], "inertia": []}
    radius = (0.75 * inertial.mass / (math.pi * _LEAD)) ** (1 / 3)
    ball = {"shape": "sphere", "size": [radius], "color": _COLOR, "origin": origin}
    box = _box(inertial, origin)
    return {"mass": [ball], "inertia": [] if box is None else [box]}


def pose_of_origin(pose: Pose) -> list[float] | None:
    """x, y, z, qx, qy, qz, qw of an origin; None if it is not finite."""
    if not all(abs(value) < _LARGEST for value in (*pose.xyz, *pose.rpy)):
        return None
    return [*pose.xyz, *pose.quaternion]


def _box(inertial: Inertial, origin: list[float]) -> dict[str, Any] | None:
    """Return the box along the principal axes; None for moments that no body has."""
    each = inertial
    tensor = np.array(
        [
            [each.ixx, each.ixy, each.ixz],
            [each.ixy, each.iyy, each.iyz],
            [each.ixz, each.iyz, each.izz],
        ]
    )
    if not np.isfinite(tensor).all():
        return None
    moments, axes = np.linalg.eigh(tensor)
    if np.linalg.det(axes) < 0:
        axes[:, 0] *= -1
    squares = 6 / inertial.mass * (moments.sum() - 2 * moments)
    if moments.min() <= 0 or squares.min() < 0 or squares.max() > _LARGEST:
        return None
    turned = quaternion_from_matrix(matrix_from_quaternion(origin[3:]) @ axes)
    return {
        "shape": "box",
        "size": [float(value) for value in np.sqrt(squares)],
        "color": _COLOR,
        "origin": [*origin[:3], *(float(value) for value in turned)],
    }
