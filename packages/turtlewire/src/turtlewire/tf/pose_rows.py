"""Poses that callers pass as an array of rows or of matrices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.errors import InvalidTransformError
from turtlewire.geometry import arrays
from turtlewire.tf.array_arguments import number_array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["matrix_row", "pose_rows"]

#: What single precision leaves of a rotation matrix.
_TOLERANCE = 1e-5
_ROW_REMEDIES = {
    (7,): "; write [pose] for a single one",
    (4, 4): "; write [matrix] for a single one",
}


def pose_rows(poses: ArrayLike, *, skip: bool = False) -> NDArray[np.float64]:
    """Return poses as rows of x, y, z, qx, qy, qz, qw.

    Args:
        poses: Shape (N, 7), or homogeneous matrices of shape (N, 4, 4).
        skip: Make a matrix that is not a rigid motion a row of NaN instead of raising.

    Raises:
        InvalidTransformError: A matrix is not a rotation and a translation.
        TypeError: An element is not a number.
        ValueError: The shape is another.
    """
    rows = number_array(poses, "poses").astype(np.float64, copy=False)
    if rows.ndim == 2 and rows.shape[1] == 7:
        return rows
    if rows.ndim != 3 or rows.shape[1:] != (4, 4):
        raise ValueError(
            f"poses must have the shape (N, 7), rows of x, y, z, qx, qy, qz, qw, or (N, 4, 4), not "
            f"{rows.shape}{_ROW_REMEDIES.get(rows.shape, '')}"
        )
    rigid = _are_rigid(rows)
    if not skip and not rigid.all():
        raise _not_a_rotation(int(np.flatnonzero(~rigid)[0]))
    found = np.full((len(rows), 7), np.nan)
    found[rigid, :3] = rows[rigid, :3, 3]
    found[rigid, 3:] = arrays.from_matrices(rows[rigid, :3, :3])
    return found


_MATRIX_REMEDIES = {
    (3, 3): "; write full = np.eye(4); full[:3, :3] = rotation",
    (3, 4): "; write np.vstack([matrix, [0, 0, 0, 1]])",
    (7,): "; for a pose of 7 numbers, write Transform(target, source, pose[:3], pose[3:])",
    (16,): "; write matrix.reshape(4, 4)",
}


def matrix_row(matrix: ArrayLike) -> list[float]:
    """Return the pose of one homogeneous matrix: x, y, z, qx, qy, qz, qw.

    Raises:
        InvalidTransformError: The matrix is not a rotation and a translation.
        TypeError: An element is not a number.
        ValueError: The shape is not (4, 4).
    """
    given = number_array(matrix, "matrix").astype(np.float64, copy=False)
    if given.shape != (4, 4):
        remedy = _MATRIX_REMEDIES.get(given.shape, "")
        if given.ndim == 3 and given.shape[1:] == (4, 4):
            remedy = "; for several, pass them to Buffer.set_transforms"
        raise ValueError(f"matrix must have the shape (4, 4), not {given.shape}{remedy}")
    row: list[float] = pose_rows(given[None], skip=True)[0].tolist()
    if np.isnan(row[6]):
        text = "matrix is not a rotation and a translation"
        if _are_rigid(given.T[None]).all():
            text += "; write matrix.T, so that it acts on columns"
        error = InvalidTransformError(text)
        error.reason = "not a rotation"
        raise error
    return row


def _are_rigid(matrices: NDArray[np.float64]) -> NDArray[Any]:
    turns = matrices[:, :3, :3]
    squares = np.einsum("nij,nkj->nik", turns, turns)
    rigid: NDArray[Any] = (
        (np.abs(squares - np.eye(3)) < _TOLERANCE).all(axis=(1, 2))
        & (np.einsum("ni,ni->n", np.cross(turns[:, 0], turns[:, 1]), turns[:, 2]) > 0.0)
        & (matrices[:, 3] == (0.0, 0.0, 0.0, 1.0)).all(axis=1)
    )
    return rigid


def _not_a_rotation(row: int) -> InvalidTransformError:
    error = InvalidTransformError(f"poses[{row}] is not a rotation and a translation")
    error.reason, error.row = "not a rotation", row
    return error
