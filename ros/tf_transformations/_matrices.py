"""Homogeneous 4x4 matrices: composed, and decomposed again."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ._quaternions import (
    EPSILON,
    euler_from_rotation,
    quaternion_from_euler,
    rotation_from_quaternion,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from ._quaternions import Axes, Quaternion

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


def _affine(linear: ArrayLike, offset: ArrayLike = (0.0, 0.0, 0.0)) -> Matrix:
    matrix = np.identity(4)
    matrix[:3, :3] = linear
    matrix[:3, 3] = offset
    return matrix


def _eigenvectors(matrix: ArrayLike, eigenvalue: float) -> list[Matrix]:
    """The real eigenvectors of one eigenvalue."""
    values, vectors = np.linalg.eig(np.asarray(matrix, dtype=np.float64))
    return [
        np.real(vectors[:, i])
        for i in np.nonzero(abs(np.real(values) - eigenvalue) < _TOLERANCE)[0]
    ]


def _fixed_point(matrix: ArrayLike) -> Matrix:
    """A point ``(x, y, z, 1)`` that the matrix leaves where it is."""
    vectors = _eigenvectors(matrix, 1.0)
    if not vectors:
        raise ValueError("no eigenvector corresponding to eigenvalue 1")
    point: Matrix = vectors[-1] / vectors[-1][3]
    return point


def identity_matrix() -> Matrix:
    """The 4x4 matrix that changes nothing."""
    return np.identity(4)


def translation_matrix(direction: Sequence[float]) -> Matrix:
    """Matrix that moves by ``direction`` (three numbers, metres)."""
    return _affine(ROTATION_IDENTITY, direction)


def translation_from_matrix(matrix: ArrayLike) -> Matrix:
    """The three numbers by which ``matrix`` moves the origin."""
    return np.array(matrix, dtype=np.float64)[:3, 3]


def reflection_matrix(point: Sequence[float], normal: Sequence[float]) -> Matrix:
    """Matrix that mirrors at the plane through ``point`` with ``normal``."""
    unit = _unit(normal)
    return _affine(
        np.identity(3) - 2.0 * np.outer(unit, unit),
        2.0 * (np.asarray(point, dtype=np.float64)[:3] @ unit) * unit,
    )


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Matrix, Matrix]:
    """A point of the mirror's plane and its normal.

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


def rotation_matrix(
    angle: float, direction: Sequence[float], point: Sequence[float] | None = None
) -> Matrix:
    """Rotation by ``angle`` [rad] about ``direction`` through ``point`` or the origin."""
    x, y, z = axis = _unit(direction)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    rotation = (
        math.cos(angle) * np.identity(3)
        + math.sin(angle) * cross
        + (1.0 - math.cos(angle)) * np.outer(axis, axis)
    )
    if point is None:
        return _affine(rotation)
    centre = np.asarray(point, dtype=np.float64)[:3]
    return _affine(rotation, centre - rotation @ centre)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix]:
    """Angle [rad], axis (3 numbers) and a point ``(x, y, z, 1)`` of the axis.

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
        math.atan2(skew @ axis / 2.0, (np.trace(rotation) - 1.0) / 2.0),
        axis,
        _fixed_point(array),
    )


def scale_matrix(
    factor: float, origin: Sequence[float] | None = None, direction: Sequence[float] | None = None
) -> Matrix:
    """Matrix that scales by ``factor``, away from ``origin``, in all directions or in one.

    A factor of -1 is a point symmetry.
    """
    centre = np.zeros(3) if origin is None else np.asarray(origin, dtype=np.float64)[:3]
    if direction is None:
        return _affine(factor * np.identity(3), (1.0 - factor) * centre)
    unit = _unit(direction)
    return _affine(
        np.identity(3) - (1.0 - factor) * np.outer(unit, unit),
        (1.0 - factor) * (centre @ unit) * unit,
    )


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix | None]:
    """Factor, a fixed point (3 numbers) and the direction, None when it scales in all directions.

    Raises:
        ValueError: The matrix leaves no point where it is.
    """
    array = np.asarray(matrix, dtype=np.float64)
    trace = float(np.trace(array[:3, :3]))
    directions = _eigenvectors(array[:3, :3], trace - 2.0)
    origin = _fixed_point(array)[:3]
    return (trace - 2.0, origin, directions[0]) if directions else (trace / 3.0, origin, None)


def projection_matrix(
    point: Sequence[float],
    normal: Sequence[float],
    direction: Sequence[float] | None = None,
    perspective: Sequence[float] | None = None,
    pseudo: bool = False,
) -> Matrix:
    """Matrix that projects onto the plane through ``point`` with ``normal``.

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
    return _affine(np.identity(3) - np.outer(along, unit), (origin @ unit) * along)


def projection_from_matrix(
    matrix: ArrayLike, pseudo: bool = False
) -> tuple[Matrix, Matrix, Matrix | None, Matrix | None, bool]:
    """Point, normal, direction, perspective, ``pseudo``: arguments of :func:`projection_matrix`.

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
    """Matrix that takes a viewing volume to the cube from -1 to 1.

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


def shear_matrix(
    angle: float, direction: Sequence[float], point: Sequence[float], normal: Sequence[float]
) -> Matrix:
    """Matrix that shears by ``angle`` [rad] along ``direction``.

    The plane through ``point`` with ``normal`` stays where it is.

    Raises:
        ValueError: The direction does not lie in the plane.
    """
    along, unit = _unit(direction), _unit(normal)
    if abs(along @ unit) > 1e-5:
        raise ValueError("direction, normal vectors not orthogonal")
    slope = math.tan(angle)
    offset = -slope * (np.asarray(point, dtype=np.float64)[:3] @ unit) * along
    return _affine(np.identity(3) + slope * np.outer(along, unit), offset)


def shear_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix, Matrix]:
    """Angle [rad], direction, point and normal, as :func:`shear_matrix` takes them.

    Raises:
        ValueError: The matrix does not shear.
    """
    array = np.asarray(matrix, dtype=np.float64)
    left, singular, right = np.linalg.svd(array[:3, :3] - np.identity(3))
    slope, direction, normal = singular[0], left[:, 0], right[0]
    if slope < EPSILON:
        raise ValueError("the matrix does not shear")
    return math.atan(slope), direction, -(array[:3, 3] @ direction) / slope * normal, normal


def orthogonal_parts(linear: ArrayLike) -> tuple[Matrix, Matrix]:
    """QR decomposition of a 3x3 matrix, with a positive diagonal of R."""
    rotation, triangle = np.linalg.qr(np.asarray(linear, dtype=np.float64))
    signs = np.where(np.diag(triangle) < 0.0, -1.0, 1.0)
    return rotation * signs, triangle * signs[:, np.newaxis]


def decompose_matrix(
    matrix: ArrayLike,
) -> tuple[Matrix, list[float], tuple[float, float, float], Matrix, Matrix]:
    """Scale, shear (x-y, x-z, y-z), Euler angles (``sxyz``), translation and perspective.

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
    if np.linalg.det(rotation) < 0.0:
        rotation, triangle = -rotation, -triangle
    scale = np.diag(triangle).copy()
    shear = [triangle[0, 1] / scale[1], triangle[0, 2] / scale[2], triangle[1, 2] / scale[2]]
    return scale, shear, euler_from_rotation(rotation.tolist()), affine[:3, 3], perspective


def compose_matrix(
    scale: Sequence[float] | None = None,
    shear: Sequence[float] | None = None,
    angles: Sequence[float] | None = None,
    translate: Sequence[float] | None = None,
    perspective: Sequence[float] | None = None,
) -> Matrix:
    """Scale, then shear, rotate (Euler angles ``sxyz``), move and apply a perspective."""
    linear = np.diag(ZOOM_IDENTITY if scale is None else [float(factor) for factor in scale])
    if shear is not None:
        xy, xz, yz = shear
        linear = np.array([[1.0, xy, xz], [0.0, 1.0, yz], [0.0, 0.0, 1.0]]) @ linear
    if angles is not None:
        roll, pitch, yaw = angles
        linear = euler_matrix(roll, pitch, yaw)[:3, :3] @ linear
    matrix = _affine(linear, TRANSLATION_IDENTITY if translate is None else translate)
    if perspective is not None:
        projection = np.identity(4)
        projection[3] = perspective
        matrix = projection @ matrix
    normalized: Matrix = matrix / matrix[3, 3]
    return normalized


def orthogonalization_matrix(lengths: Sequence[float], angles: Sequence[float]) -> Matrix:
    """Matrix from crystallographic to Cartesian coordinates.

    The cell has three ``lengths``, and three ``angles`` in degrees.
    """
    a, b, c = lengths
    alpha, beta, gamma = (math.radians(angle) for angle in angles)
    along = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (
        math.sin(alpha) * math.sin(beta)
    )
    return _affine(
        [
            [a * math.sin(beta) * math.sqrt(1.0 - along * along), 0.0, 0.0],
            [-a * math.sin(beta) * along, b * math.sin(alpha), 0.0],
            [a * math.cos(beta), b * math.cos(alpha), c],
        ]
    )


def euler_matrix(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Matrix:
    """Rotation matrix of three angles [rad].

    :func:`quaternion_from_euler` explains ``axes``.
    """
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """Angles [rad] of the rotation in a 4x4 or 3x3 matrix."""
    return euler_from_rotation(np.asarray(matrix, dtype=np.float64)[:3, :3].tolist(), axes)


def quaternion_matrix(quaternion: Sequence[float]) -> Matrix:
    """Rotation matrix of a quaternion, which need not be normalised."""
    return _affine(rotation_from_quaternion(quaternion))


def quaternion_from_matrix(matrix: ArrayLike) -> Quaternion:
    """Quaternion, with ``w >= 0``, of the rotation in a 4x4 matrix.

    Its scales, shears and its translation are left aside.

    Raises:
        ValueError: The matrix is singular.
    """
    array = np.asarray(matrix, dtype=np.float64)[:3, :3]
    if not np.linalg.det(array):
        raise ValueError("Matrix is singular")
    rotation, _ = orthogonal_parts(array)
    if np.linalg.det(rotation) < 0.0:
        rotation[:, 0] *= -1.0
    return _quaternion_from_rotation(rotation.tolist())


def _quaternion_from_rotation(rotation: Sequence[Sequence[float]]) -> Quaternion:
    trace = rotation[0][0] + rotation[1][1] + rotation[2][2]
    if trace > 0.0:
        s = 2.0 * math.sqrt(1.0 + trace)
        x, y, z = (
            (rotation[2][1] - rotation[1][2]) / s,
            (rotation[0][2] - rotation[2][0]) / s,
            (rotation[1][0] - rotation[0][1]) / s,
        )
        return x + 0.0, y + 0.0, z + 0.0, s / 4.0  # no negative zeros
    i = max(range(3), key=lambda axis: rotation[axis][axis])
    j, k = (i + 1) % 3, (i + 2) % 3
    s = 2.0 * math.sqrt(1.0 + rotation[i][i] - rotation[j][j] - rotation[k][k])
    vector = [0.0, 0.0, 0.0]
    vector[i] = s / 4.0
    vector[j] = (rotation[j][i] + rotation[i][j]) / s
    vector[k] = (rotation[k][i] + rotation[i][k]) / s
    w = (rotation[k][j] - rotation[j][k]) / s
    sign = -1.0 if w < 0.0 else 1.0
    return sign * vector[0] + 0.0, sign * vector[1] + 0.0, sign * vector[2] + 0.0, sign * w + 0.0


def inverse_matrix(matrix: ArrayLike) -> Any:
    """The matrix that undoes ``matrix``; any square one."""
    return np.linalg.inv(np.asarray(matrix))


def concatenate_matrices(*matrices: ArrayLike) -> Matrix:
    """The product of the matrices; the last one acts first."""
    product = np.identity(4)
    for matrix in matrices:
        product = product @ np.asarray(matrix, dtype=np.float64)
    return product


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Whether both matrices do the same, to rounding; a common factor does not count."""
    first, second = np.asarray(matrix0, dtype=np.float64), np.asarray(matrix1, dtype=np.float64)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))
