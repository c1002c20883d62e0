"""The drawing of pose covariances: an ellipsoid, and the uncertainty of the heading."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.geometry import arrays

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["covariance_shape"]

_LARGEST = 1e9


def covariance_shape(covariance: Any, warn: Callable[[str], None]) -> dict[str, Any] | None:
    """Return the shape of a 6x6 covariance: x, y, z, roll, pitch, yaw.

    Args:
        covariance: 36 numbers, row by row.
        warn: Gets a message if they are not a covariance.

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
        "rotation": arrays.from_matrices(vectors).tolist(),
        "yaw": min(math.pi, math.sqrt(float(matrix[5, 5]))),
    }
