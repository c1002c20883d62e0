"""The arithmetic of many quaternions, in arrays of the shape ``(..., 4)``.

`turtlewire.geometry.conversions` has functions for callers that check their arguments.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "angle",
    "conjugate",
    "distances",
    "euler",
    "from_matrices",
    "lengths",
    "matrices",
    "multiply",
    "normalised",
    "rotate",
    "upper",
]

#: Quaternions have the length 1 if they differ by less: by some roundings of a double.
_UNIT = 1e-14


def multiply(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rotations that do ``b`` first, then ``a``; the leading axes are broadcast."""
    ax, ay, az, aw = np.moveaxis(a, -1, 0)
    bx, by, bz, bw = np.moveaxis(b, -1, 0)
    return np.stack(
        (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ),
        axis=-1,
    )


def conjugate(q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the inverse rotations."""
    inverse: NDArray[np.float64] = q * np.array((-1.0, -1.0, -1.0, 1.0))
    return inverse


def rotate(q: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the vectors ``v``, turned by ``q``; the leading axes are broadcast."""
    axis, w = q[..., :3], q[..., 3:]
    t = 2.0 * _cross(axis, v)
    turned: NDArray[np.float64] = v + w * t + _cross(axis, t)
    return turned


def _cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the cross products; `numpy.cross` takes three times as long."""
    ax, ay, az = np.moveaxis(a, -1, 0)
    bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), axis=-1)


def lengths(v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the lengths (N,) of vectors (N, K): `numpy.linalg.norm` takes four times as long."""
    squares: NDArray[np.float64] = np.einsum("ij,ij->i", v, v)
    return np.sqrt(squares, out=squares)


def normalised(q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return quaternions (N, 4) of the length 1; those that have it already stay as they are."""
    norms = lengths(q)
    off = np.abs(norms - 1.0) > _UNIT
    if not off.any():
        return q
    unit: NDArray[np.float64] = q.copy()
    unit[off] /= norms[off, None]
    return unit


def distances(p: NDArray[np.float64], q: NDArray[np.float64]) -> NDArray[np.float64]:
    """The distances (N,) of points (N, 3), column by column: half the time of `lengths` (q - p)."""
    squares = np.zeros(len(p))
    for column in range(3):
        difference = q[:, column] - p[:, column]
        squares += np.multiply(difference, difference, out=difference)
    return np.sqrt(squares, out=squares)


def angle(q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the angle of each rotation in radians, from 0 to pi."""
    sine = np.linalg.norm(q[..., :3], axis=-1)
    half: NDArray[np.float64] = np.arctan2(sine, np.abs(q[..., 3]))
    return 2.0 * half


def matrices(q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rotation matrices, shape (..., 3, 3)."""
    x, y, z, w = np.moveaxis(q, -1, 0)
    matrix = np.empty((*q.shape[:-1], 3, 3))
    matrix[..., 0, 0] = 1 - 2 * (y * y + z * z)
    matrix[..., 0, 1] = 2 * (x * y - w * z)
    matrix[..., 0, 2] = 2 * (x * z + w * y)
    matrix[..., 1, 0] = 2 * (x * y + w * z)
    matrix[..., 1, 1] = 1 - 2 * (x * x + z * z)
    matrix[..., 1, 2] = 2 * (y * z - w * x)
    matrix[..., 2, 0] = 2 * (x * z - w * y)
    matrix[..., 2, 1] = 2 * (y * z + w * x)
    matrix[..., 2, 2] = 1 - 2 * (x * x + y * y)
    return matrix


def from_matrices(m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the quaternions, with w >= 0, of rotation matrices of the shape (..., 3, 3).

    Scale and shear are not detected.
    """
    diagonal = np.diagonal(m, axis1=-2, axis2=-1)
    trace = diagonal.sum(axis=-1)
    # Four formulas for the same quaternion, each scaled by four times one component. The formula of
    # the largest component loses no digits (Shepperd 1978).
    ways = np.empty((*m.shape[:-2], 4, 4))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        ways[..., i, i] = 1 + 2 * diagonal[..., i] - trace
        ways[..., i, j] = ways[..., j, i] = m[..., j, i] + m[..., i, j]
        ways[..., i, 3] = ways[..., 3, i] = m[..., k, j] - m[..., j, k]
    ways[..., 3, 3] = 1 + trace
    largest = np.argmax(np.diagonal(ways, axis1=-2, axis2=-1), axis=-1)[..., None, None]
    q = np.take_along_axis(ways, largest, axis=-2)[..., 0, :]
    return upper(q / np.sqrt(np.einsum("...i,...i", q, q))[..., None])


def upper(q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the quaternions of the same rotations with w >= 0."""
    return np.where(q[..., 3:] < 0.0, -q, q)


def euler(q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Roll, pitch and yaw (N, 3) in radians: turns about the fixed axes x, then y, then z."""
    x, y, z, w = np.moveaxis(q, -1, 0)
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.stack((roll, pitch, yaw), axis=-1)
