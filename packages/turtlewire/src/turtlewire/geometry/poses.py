"""tf2's arithmetic of poses: plain tuples ``(x, y, z, qx, qy, qz, qw)``.

A pose is named ``parent_from_child``.
"""

from __future__ import annotations

import math
from typing import TypeAlias

from turtlewire.geometry.quaternions import (
    conjugate,
    multiply,
    rotate,
    rotate_scaling,
    through_matrix,
)

Pose: TypeAlias = tuple[float, float, float, float, float, float, float]

IDENTITY: Pose = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def compose(a: Pose, b: Pose) -> Pose:
    """Return ``a_from_c`` for ``a_from_b`` and ``b_from_c``."""
    x, y, z = rotate(a[3:], b[:3])
    return (a[0] + x, a[1] + y, a[2] + z, *multiply(a[3:], b[3:]))


def between(a: Pose, b: Pose) -> Pose:
    """Return ``a_from_b`` for ``top_from_a`` and ``top_from_b``."""
    back = conjugate(a[3:])
    return (*rotate(back, (b[0] - a[0], b[1] - a[1], b[2] - a[2])), *multiply(back, b[3:]))


def compose_scaling(a: Pose, b: Pose) -> Pose:
    """Compose poses as `compose` does, with quaternions of any length, which scale.

    tf2 has done so since Kilted, where it stores quaternions as they were sent.
    """
    x, y, z = rotate_scaling(a[3:], b[:3])
    return (a[0] + x, a[1] + y, a[2] + z, *multiply(a[3:], b[3:]))


def between_scaling(a: Pose, b: Pose) -> Pose:
    """Relate poses as `between` does, with quaternions of any length, which scale."""
    back = conjugate(a[3:])
    way = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    return (*rotate_scaling(back, way), *multiply(back, b[3:]))


def canonical(pose: Pose) -> Pose:
    """Return the pose with its quaternion converted to a rotation matrix and back.

    tf2 does so with every result, which fixes the sign and the last bits of the quaternion.
    """
    return (*pose[:3], *through_matrix(pose[3:]))


def interpolate(older: Pose, newer: Pose, ratio: float) -> Pose:
    """Return the pose at the part ``ratio`` of the way: on a straight line and the shortest arc."""
    cosine = sum(a * b for a, b in zip(older[3:], newer[3:], strict=True))
    angle = math.acos(min(abs(cosine), 1.0))
    # The arc of a small angle is a straight line to the last bit.
    weights = (1.0 - ratio, ratio) if angle < 1e-8 else _arc_weights(angle, ratio)
    return _mix(older, newer, ratio, weights, cosine)


def interpolate_scaling(older: Pose, newer: Pose, ratio: float) -> Pose:
    """Interpolate as `interpolate` does, between quaternions of any length.

    The weights follow the angle between them; of two with one direction, the older is taken.
    """
    cosine = sum(a * b for a, b in zip(older[3:], newer[3:], strict=True))
    lengths = math.hypot(*older[3:]) * math.hypot(*newer[3:])
    angle = math.acos(min(abs(cosine) / lengths, 1.0))
    weights = _arc_weights(angle, ratio) if angle else (1.0, 0.0)
    return _mix(older, newer, ratio, weights, cosine)


def _arc_weights(angle: float, ratio: float) -> tuple[float, float]:
    scale = 1.0 / math.sin(angle)
    return math.sin((1.0 - ratio) * angle) * scale, math.sin(ratio * angle) * scale


def _mix(
    older: Pose, newer: Pose, ratio: float, weights: tuple[float, float], cosine: float
) -> Pose:
    """Mix translations by the ratio, and quaternions by their weights, on the shorter way."""
    back = 1.0 - ratio
    keep, take = weights
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
