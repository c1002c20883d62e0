"""Homogeneous 4x4 matrices: composed, and decomposed again."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ._quaternions import (
    EPSILON,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.geometry.quaternions import Numbers

    Matrix = NDArray[np.float64]

TRANSLATION_IDENTITY = [0.0, 0.0, 0.0]
ROTATION_IDENTITY = np.identity(3, dtype=np.float64)
ZOOM_IDENTITY = [1.0, 1.0, 1.0]
SHEAR_IDENTITY = TRANSLATION_IDENTITY

#: How near an eigenvalue must be to the one looked for.
_TOLERANCE = 1e-8


def _unit(vector: ArrayLike) -> Matrix:
    array = np.asarray(vector, dtype=np.float64)[:3]
    return array / math.sqrt(array @ array)


def affine_matrix(linear: ArrayLike, offset: ArrayLike = (0.0, 0.0, 0.0)) -> Matrix:
    """Return the matrix of a linear map, shape (3, 3), followed by a translation."""
    matrix = np.identity(4)
    matrix[:3, :3] = linear
    matrix[:3, 3] = offset
    return matrix


def _eigenvectors(matrix: ArrayLike, eigenvalue: float) -> list[Matrix]:
    """Return the real eigenvectors of one eigenvalue."""
    values, vectors = np.linalg.eig(np.asarray(matrix, dtype=np.float64))
    return [
        np.real(vectors[:, i])
        for i in np.nonzero(abs(np.real(values) - eigenvalue) < _TOLERANCE)[0]
    ]


def _fixed_point(matrix: ArrayLike) -> Matrix:
    """Return a point ``(x, y, z, 1)`` that the matrix leaves where it is."""
    vectors = _eigenvectors(matrix, 1.0)
    if not vectors:
        raise ValueError("no eigenvector corresponding to eigenvalue 1")
    point: Matrix = vectors[-1] / vectors[-1][3]
    return point


def identity_matrix() -> Matrix:
    """Return the 4x4 matrix that changes nothing."""
    return np.identity(4)


def translation_matrix(direction: Numbers) -> Matrix:
    """Return the matrix that moves by ``direction`` (three numbers, metres)."""
    return affine_matrix(ROTATION_IDENTITY, direction)


def translation_from_matrix(matrix: ArrayLike) -> Matrix:
    """Return the three numbers by which ``matrix`` moves the origin."""
    return np.array(matrix, dtype=np.float64)[:3, 3]


def reflection_matrix(point: Numbers, normal: Numbers) -> Matrix:
    """Return the matrix that mirrors at the plane through ``point`` with ``normal``."""
    unit = _unit(normal)
    return affine_matrix(
        np.identity(3) - 2.0 * np.outer(unit, unit),
        2.0 * (np.asarray(point, dtype=np.float64)[:3] @ unit) * unit,
    )


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Matrix, Matrix]:
    """Return a point of the mirror's plane and its normal.

    Raises:
        ValueError: The matrix is not a reflection.
    """
    array = np.asarray(matrix, dtype=np.float64)
    normals = _eigenvectors(array[:3, :3], -1.0)
    if not normals:
        raise ValueError("no unit eigenvector corresponding to eigenvalue -1")
    if abs(np.linalg.det(array[:3, :3]) + 1.0) > _TOLERANCE:
        raise ValueError("Determinant should be -1")
    return _fixed_point(array)[:3], normals[0]


def rotation_matrix(angle: float, direction: Numbers, point: Numbers | None = None) -> Matrix:
    """Return the rotation by ``angle`` [rad] about ``direction``, through ``point`` if given."""
    x, y, z = axis = _unit(direction)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    rotation = (
        math.cos(angle) * np.identity(3)
        + math.sin(angle) * cross
        + (1.0 - math.cos(angle)) * np.outer(axis, axis)
    )
    if point is None:
        return affine_matrix(rotation)
    centre = np.asarray(point, dtype=np.float64)[:3]
    return affine_matrix(rotation, centre - rotation @ centre)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix]:
    """Return the angle [rad], axis (3 numbers) and a point ``(x, y, z, 1)`` of the axis.

    Raises:
        ValueError: The matrix is not a rotation about an axis.
    """
    array = np.asarray(matrix, dtype=np.float64)
    rotation = array[:3, :3]
    axes = _eigenvectors(rotation.T, 1.0)
    if not axes:
        raise ValueError("no unit eigenvector corresponding to eigenvalue 1")
    axis = axes[-1]
    skew = np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    return (
        # From sine and cosine: the arc cosine of the trace alone loses digits near 0 and half a
        # turn, and the sign.
        math.atan2(skew @ axis / 2.0, (np.trace(rotation) - 1.0) / 2.0),
        axis,
        _fixed_point(array),
    )


def scale_matrix(
    factor: float, origin: Numbers | None = None, direction: Numbers | None = None
) -> Matrix:
    """Return the matrix that scales by ``factor`` from ``origin``, in all directions or in one.

    A factor of -1 is a point symmetry.
    """
    centre = np.zeros(3) if origin is None else np.asarray(origin, dtype=np.float64)[:3]
    if direction is None:
        return affine_matrix(factor * np.identity(3), (1.0 - factor) * centre)
    unit = _unit(direction)
    return affine_matrix(
        np.identity(3) - (1.0 - factor) * np.outer(unit, unit),
        (1.0 - factor) * (centre @ unit) * unit,
    )


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix | None]:
    """Return factor, fixed point (3 numbers) and direction, None if it scales in all directions.

    Raises:
        ValueError: The matrix leaves no point where it is.
    """
    array = np.asarray(matrix, dtype=np.float64)
    trace = float(np.trace(array[:3, :3]))
    # Scaling in one direction leaves two eigenvalues at 1, so the trace gives the third.
    directions = _eigenvectors(array[:3, :3], trace - 2.0)
    origin = _fixed_point(array)[:3]
    return (trace - 2.0, origin, directions[0]) if directions else (trace / 3.0, origin, None)


def projection_matrix(
    point: Numbers,
    normal: Numbers,
    direction: Numbers | None = None,
    perspective: Numbers | None = None,
    pseudo: bool = False,
) -> Matrix:
    """Return the matrix that projects onto the plane through ``point`` with ``normal``.

    Args:
        point: A point of the plane.
        normal: Normal of the plane.
        direction: Projects along this direction; along the normal when neither this nor
            ``perspective`` is given.
        perspective: Projects towards this eye point.
        pseudo: Keep the order of depths in a perspective projection.
    """
    matrix = np.identity(4)
    origin, unit = np.asarray(point, dtype=np.float64)[:3], _unit(normal)
    if perspective is not None:
        eye = np.asarray(perspective, dtype=np.float64)[:3]
        matrix[:3, :3] = ((eye - origin) @ unit) * np.identity(3) - np.outer(
            eye + unit if pseudo else eye, unit
        )
        matrix[:3, 3] = (origin @ unit) * (eye + unit if pseudo else eye)
        matrix[3, :3] = -unit
        matrix[3, 3] = eye @ unit
        return matrix
    along = unit if direction is None else np.asarray(direction, dtype=np.float64)[:3]
    along = along / (along @ unit)
    return affine_matrix(np.identity(3) - np.outer(along, unit), (origin @ unit) * along)


def projection_from_matrix(
    matrix: ArrayLike, pseudo: bool = False
) -> tuple[Matrix, Matrix, Matrix | None, Matrix | None, bool]:
    """Return point, normal, direction, perspective, ``pseudo``, as for :func:`projection_matrix`.

    Raises:
        ValueError: The matrix is not a projection.
    """
    array = np.asarray(matrix, dtype=np.float64)
    fixed = _eigenvectors(array, 1.0)
    if fixed and not pseudo:
        point = fixed[-1] / fixed[-1][3]
        directions, normals = _eigenvectors(array[:3, :3], 0.0), _eigenvectors(array[:3, :3].T, 0.0)
        if not directions:
            raise ValueError("no eigenvector corresponding to eigenvalue 0")
        return (
            point,
            _unit(normals[0]) if normals else _unit(directions[0]),
            _unit(directions[0]),
            None,
            False,
        )
    values, vectors = np.linalg.eig(array)
    moved = np.nonzero(abs(np.real(values)) > _TOLERANCE)[0]
    if not len(moved):
        raise ValueError("no eigenvector not corresponding to eigenvalue 0")
    point = np.real(vectors[:, moved[-1]])
    point = point / point[3]
    normal = -array[3, :3]
    perspective = array[:3, 3] / (point[:3] @ normal)
    return point, normal, None, perspective - normal if pseudo else perspective, pseudo


def clip_matrix(
    left: float,
    right: float,
    bottom: float,
    top: float,
    near: float,
    far: float,
    perspective: bool = False,
) -> Matrix:
    """Return the matrix that takes a viewing volume to the cube from -1 to 1.

    A box, or with ``perspective`` a frustum.

    Raises:
        ValueError: The bounds are not in order.
    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError("invalid frustrum")
    width, height, depth = right - left, top - bottom, far - near
    if not perspective:
        matrix = np.diag([2.0 / width, 2.0 / height, 2.0 / depth, 1.0])
        matrix[:3, 3] = -(right + left) / width, -(top + bottom) / height, -(far + near) / depth
        return matrix
    if near <= EPSILON:
        raise ValueError("invalid frustrum: near <= 0")
    matrix = np.diag([-2.0 * near / width, -2.0 * near / height, -(far + near) / depth, 0.0])
    matrix[:3, 2] = (right + left) / width, (top + bottom) / height, -(far + near) / depth
    matrix[2, 3] = 2.0 * near * far / depth
    matrix[3, 2] = -1.0
    return matrix


def shear_matrix(angle: float, direction: Numbers, point: Numbers, normal: Numbers) -> Matrix:
    """Return the matrix that shears by ``angle`` [rad] along ``direction``.

    The plane through ``point`` with ``normal`` stays where it is.

    Raises:
        ValueError: The direction does not lie in the plane.
    """
    along, unit = _unit(direction), _unit(normal)
    if abs(along @ unit) > 1e-5:
        raise ValueError("direction, normal vectors not orthogonal")
    slope = math.tan(angle)
    offset = -slope * (np.asarray(point, dtype=np.float64)[:3] @ unit) * along
    return affine_matrix(np.identity(3) + slope * np.outer(along, unit), offset)


def shear_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix, Matrix]:
    """Return angle [rad], direction, point and normal, as :func:`shear_matrix` takes them.

    Raises:
        ValueError: The matrix does not shear.
    """
    array = np.asarray(matrix, dtype=np.float64)
    left, singular, right = np.linalg.svd(array[:3, :3] - np.identity(3))
    # A shear is the identity and one outer product, so only one singular value is not zero.
    slope, direction, normal = singular[0], left[:, 0], right[0]
    if slope < EPSILON:
        raise ValueError("the matrix does not shear")
    return math.atan(slope), direction, -(array[:3, 3] @ direction) / slope * normal, normal


def inverse_matrix(matrix: ArrayLike) -> Any:
    """Return the matrix that undoes ``matrix``; any square one."""
    return np.linalg.inv(np.asarray(matrix))


def concatenate_matrices(*matrices: ArrayLike) -> Matrix:
    """Return the product of the matrices; the last one acts first."""
    product = np.identity(4)
    for matrix in matrices:
        product = product @ np.asarray(matrix, dtype=np.float64)
    return product


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Return True if both matrices do the same, to rounding; a common factor does not count."""
    first, second = np.asarray(matrix0, dtype=np.float64), np.asarray(matrix1, dtype=np.float64)
    # Homogeneous matrices that differ by a factor are the same transform.
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))
