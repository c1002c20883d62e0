"""Covariances of poses as what is drawn of them: an ellipsoid, and how uncertain the heading is."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["covariance_shape"]

_LARGEST = 1e9


def covariance_shape(covariance: Any, warn: Callable[[str], None]) -> dict[str, Any] | None:
    """Return the shape of a 6x6 covariance: x, y, z, roll, pitch, yaw.

    Args:
        covariance: 36 numbers, row by row.
        warn: Gets a line if they are no covariance.

    Returns:
        ``radii`` of one standard deviation along the axes of ``rotation`` (xyzw), for the position;
        ``yaw``, the standard deviation of the heading in radians. None if it is all zeros, which
        means that the sender does not know, or no covariance.
    """
    matrix = np.asarray(covariance, dtype=np.float64).reshape(6, 6)
    if not matrix.any():
        return None
    if not (np.abs(np.nan_to_num(matrix, nan=math.inf)) < _LARGEST).all():
        warn("the covariance holds a number that is not finite or too large")
        return None
    position = (matrix[:3, :3] + matrix[:3, :3].T) / 2
    values, vectors = np.linalg.eigh(position)
    tolerance = 1e-9 * max(1.0, float(np.abs(values).max()))
    if values[0] < -tolerance or matrix[5, 5] < 0:
        warn("the covariance has negative variances")
        return None
    radii = np.sqrt(np.maximum(values, 0.0))
    if np.linalg.det(vectors) < 0:
        vectors[:, 0] = -vectors[:, 0]
    return {
        "radii": [float(radius) for radius in radii],
        "rotation": _quaternion(vectors),
        "yaw": min(math.pi, math.sqrt(float(matrix[5, 5]))),
    }


def _quaternion(rotation: Any) -> list[float]:
    """x, y, z, w of a rotation matrix: the eigenvector of Bar-Itzhack's symmetric matrix.

    See I. Y. Bar-Itzhack, "New method for extracting the quaternion from a rotation matrix",
    Journal of Guidance, Control, and Dynamics 23(6), 2000.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation
    symmetric = np.array(
        [
            [xx - yy - zz, yx + xy, zx + xz, zy - yz],
            [yx + xy, yy - xx - zz, zy + yz, xz - zx],
            [zx + xz, zy + yz, zz - xx - yy, yx - xy],
            [zy - yz, xz - zx, yx - xy, xx + yy + zz],
        ]
    )
    quaternion = np.linalg.eigh(symmetric)[1][:, -1]
    return [float(value) for value in quaternion]
