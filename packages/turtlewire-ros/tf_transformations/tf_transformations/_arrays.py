"""Vectors of any length, interpolation and random rotations."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ._composition import quaternion_matrix
from ._matrices import identity_matrix
from ._quaternions import EPSILON

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.geometry.quaternions import Numbers


def vector_norm(
    data: ArrayLike, axis: int | None = None, out: NDArray[np.float64] | None = None
) -> Any:
    """Return the Euclidean length along ``axis``, of all numbers together when that is None.

    Written into ``out`` (and None returned) if given.
    """
    squares = np.square(np.asarray(data, dtype=np.float64)).sum(axis=axis)
    if out is None:
        return np.sqrt(squares)
    np.sqrt(squares, out)
    return None


def unit_vector(
    data: ArrayLike, axis: int | None = None, out: NDArray[np.float64] | None = None
) -> Any:
    """Return the array divided by its length along ``axis``.

    Written into ``out`` (and None returned) if given.
    """
    array = np.asarray(data, dtype=np.float64)
    unit = array / np.sqrt(np.square(array).sum(axis=axis, keepdims=axis is not None))
    if out is None:
        return unit
    out[...] = unit
    return None


def random_vector(size: int | tuple[int, ...]) -> Any:
    """Return uniform random numbers in [0, 1), an array of shape ``size``."""
    # The caller's numpy.random.seed decides, as in the original.
    return np.random.random(size)  # noqa: NPY002


def random_quaternion(rand: Numbers | None = None) -> NDArray[np.float64]:
    """Return a unit quaternion ``(x, y, z, w)``, uniform over all rotations.

    ``rand`` may give the three numbers in [0, 1) to make it of.
    """
    # Shoemake's method: three independent numbers of that form are uniform over all rotations.
    share, first, second = random_vector(3) if rand is None else rand
    inner, outer = math.sqrt(1.0 - share), math.sqrt(share)
    turn, twist = 2.0 * math.pi * first, 2.0 * math.pi * second
    return np.array(
        [
            math.sin(turn) * inner,
            math.cos(turn) * inner,
            math.sin(twist) * outer,
            math.cos(twist) * outer,
        ]
    )


def random_rotation_matrix(rand: Numbers | None = None) -> NDArray[np.float64]:
    """Return the rotation matrix of :func:`random_quaternion`."""
    return quaternion_matrix(random_quaternion(rand).tolist())


def quaternion_slerp(
    quat0: Numbers,
    quat1: Numbers,
    fraction: float,
    spin: int = 0,
    shortestpath: bool = True,
) -> NDArray[np.float64]:
    """Interpolate between two rotations at constant angular speed.

    Args:
        quat0: Rotation at fraction 0, ``(x, y, z, w)``.
        quat1: Rotation at fraction 1.
        fraction: Where; outside of [0, 1] it extrapolates.
        spin: Additional half turns on the way.
        shortestpath: Go the shorter way round.
    """
    start: NDArray[np.float64] = unit_vector(quat0[:4])
    end: NDArray[np.float64] = unit_vector(quat1[:4])
    cosine = float(start @ end)
    if fraction == 0.0 or abs(abs(cosine) - 1.0) < EPSILON:
        return start
    if fraction == 1.0:
        return end
    # A quaternion and its opposite are the same rotation.
    if shortestpath and cosine < 0.0:
        cosine, end = -cosine, -end
    angle = math.acos(cosine) + spin * math.pi
    if abs(angle) < EPSILON:
        return start
    return (
        start * math.sin((1.0 - fraction) * angle) + end * math.sin(fraction * angle)
    ) / math.sin(angle)


def superimposition_matrix(
    v0: ArrayLike, v1: ArrayLike, scaling: bool = False, usesvd: bool = True
) -> NDArray[np.float64]:
    """Return the matrix that lays points over points with the least squared distance.

    Args:
        v0: Points as columns, shape (3, n) or (4, n).
        v1: The points to come to, same shape.
        scaling: Allow a change of size.
        usesvd: Kabsch's way by singular values; else Horn's by the quaternion of the largest
            eigenvalue. Both find the same.
    """
    points, goals = np.asarray(v0, dtype=np.float64)[:3], np.asarray(v1, dtype=np.float64)[:3]
    if points.shape != goals.shape or points.shape[1] < 3:
        raise ValueError("Vector sets are of wrong shape or type.")
    centre, goal = points.mean(axis=1), goals.mean(axis=1)
    points, goals = points - centre[:, np.newaxis], goals - goal[:, np.newaxis]
    rotation = _rotation_by_svd(points, goals) if usesvd else _rotation_by_quaternion(points, goals)
    if scaling:
        rotation = rotation * math.sqrt(np.square(goals).sum() / np.square(points).sum())
    matrix = identity_matrix()
    matrix[:3, :3] = rotation
    matrix[:3, 3] = goal - rotation @ centre
    return matrix


def _rotation_by_svd(
    points: NDArray[np.float64], goals: NDArray[np.float64]
) -> NDArray[np.float64]:
    left, _, right = np.linalg.svd(goals @ points.T)
    # Without it, points of a mirrored body would give a reflection.
    handedness = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation: NDArray[np.float64] = left @ handedness @ right
    return rotation


def _rotation_by_quaternion(
    points: NDArray[np.float64], goals: NDArray[np.float64]
) -> NDArray[np.float64]:
    s = points @ goals.T
    vector = np.array([s[1, 2] - s[2, 1], s[2, 0] - s[0, 2], s[0, 1] - s[1, 0]])
    quadratic = np.empty((4, 4))
    quadratic[:3, :3] = s + s.T - np.trace(s) * np.identity(3)
    quadratic[:3, 3] = quadratic[3, :3] = vector
    quadratic[3, 3] = np.trace(s)
    # Eigenvalues ascend, so the last eigenvector is that of the largest.
    _, vectors = np.linalg.eigh(quadratic)
    return quaternion_matrix(vectors[:, -1].tolist())[:3, :3]
