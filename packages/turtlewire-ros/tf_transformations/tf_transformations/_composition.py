"""Matrices of Euler angles and quaternions, and of all parts of a transform together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.geometry import quaternions

from ._matrices import (
    TRANSLATION_IDENTITY,
    ZOOM_IDENTITY,
    affine_matrix,
)
from ._quaternions import (
    EPSILON,
    euler_from_rotation,
    quaternion_from_euler,
    rotation_from_quaternion,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from turtlewire.geometry.quaternions import Numbers, Quaternion

    from ._matrices import Matrix
    from ._quaternions import Axes


def euler_matrix(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Matrix:
    """Return the rotation matrix of three angles [rad].

    :func:`quaternion_from_euler` explains ``axes``.
    """
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """Return the angles [rad] of the rotation in a 4x4 or 3x3 matrix."""
    return euler_from_rotation(np.asarray(matrix, dtype=np.float64)[:3, :3].tolist(), axes)


def quaternion_matrix(quaternion: Numbers) -> Matrix:
    """Return the rotation matrix of a quaternion, which need not be normalised."""
    return affine_matrix(rotation_from_quaternion(quaternion))


def quaternion_from_matrix(matrix: ArrayLike) -> Quaternion:
    """Return the quaternion, with ``w >= 0``, of the rotation in a 4x4 matrix.

    Its scales, shears and its translation are left aside.

    Raises:
        ValueError: The matrix is singular.
    """
    array = np.asarray(matrix, dtype=np.float64)[:3, :3]
    if not np.linalg.det(array):
        raise ValueError("Matrix is singular")
    rotation, _ = orthogonal_parts(array)
    # A reflection has no quaternion; which axis is mirrored is arbitrary.
    if np.linalg.det(rotation) < 0.0:
        rotation[:, 0] *= -1.0
    x, y, z, w = quaternions.from_matrix(tuple(rotation.ravel().tolist()))
    sign = -1.0 if w < 0.0 else 1.0
    return sign * x + 0.0, sign * y + 0.0, sign * z + 0.0, sign * w + 0.0  # no negative zeros


def orthogonal_parts(linear: ArrayLike) -> tuple[Matrix, Matrix]:
    """Return the QR decomposition of a 3x3 matrix, with a positive diagonal of R."""
    rotation, triangle = np.linalg.qr(np.asarray(linear, dtype=np.float64))
    # NumPy leaves the signs open; with positive ones the decomposition is unique.
    signs = np.where(np.diag(triangle) < 0.0, -1.0, 1.0)
    return rotation * signs, triangle * signs[:, np.newaxis]


def decompose_matrix(
    matrix: ArrayLike,
) -> tuple[Matrix, list[float], tuple[float, float, float], Matrix, Matrix]:
    """Return scale, shear (x-y, x-z, y-z), Euler angles (``sxyz``), translation and perspective.

    These are the arguments of :func:`compose_matrix`.

    Raises:
        ValueError: The matrix is singular.
    """
    array = np.array(matrix, dtype=np.float64)
    if abs(array[3, 3]) < EPSILON:
        raise ValueError("M[3, 3] is zero")
    array /= array[3, 3]
    affine = array.copy()
    affine[3] = 0.0, 0.0, 0.0, 1.0
    if not np.linalg.det(affine):
        raise ValueError("Matrix is singular")
    perspective = array[3] @ np.linalg.inv(affine)
    rotation, triangle = orthogonal_parts(affine[:3, :3])
    # A mirrored matrix: the scales get the minus signs, so that the rest is a rotation.
    if np.linalg.det(rotation) < 0.0:
        rotation, triangle = -rotation, -triangle
    scale = np.diag(triangle).copy()
    shear = [triangle[0, 1] / scale[1], triangle[0, 2] / scale[2], triangle[1, 2] / scale[2]]
    return scale, shear, euler_from_rotation(rotation.tolist()), affine[:3, 3], perspective


def compose_matrix(
    scale: Numbers | None = None,
    shear: Numbers | None = None,
    angles: Numbers | None = None,
    translate: Numbers | None = None,
    perspective: Numbers | None = None,
) -> Matrix:
    """Scale, then shear, rotate (Euler angles ``sxyz``), move and apply a perspective."""
    linear = np.diag(ZOOM_IDENTITY if scale is None else [float(factor) for factor in scale])
    if shear is not None:
        xy, xz, yz = shear
        linear = np.array([[1.0, xy, xz], [0.0, 1.0, yz], [0.0, 0.0, 1.0]]) @ linear
    if angles is not None:
        roll, pitch, yaw = angles
        linear = euler_matrix(roll, pitch, yaw)[:3, :3] @ linear
    matrix = affine_matrix(linear, TRANSLATION_IDENTITY if translate is None else translate)
    if perspective is not None:
        projection = np.identity(4)
        projection[3] = perspective
        matrix = projection @ matrix
    normalized: Matrix = matrix / matrix[3, 3]
    return normalized


def orthogonalization_matrix(lengths: Numbers, angles: Numbers) -> Matrix:
    """Return the matrix from crystallographic to Cartesian coordinates.

    The cell has three ``lengths``, and three ``angles`` in degrees.
    """
    a, b, c = lengths
    alpha, beta, gamma = (math.radians(angle) for angle in angles)
    along = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (
        math.sin(alpha) * math.sin(beta)
    )
    return affine_matrix(
        [
            [a * math.sin(beta) * math.sqrt(1.0 - along * along), 0.0, 0.0],
            [-a * math.sin(beta) * along, b * math.sin(alpha), 0.0],
            [a * math.cos(beta), b * math.cos(alpha), c],
        ]
    )
