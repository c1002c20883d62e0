"""Rotations and poses as numbers: one at a time on plain floats, or many at once in arrays.

::

    from turtlewire import geometry

    matrices = geometry.matrix_from_pose(poses)                        # (N, 7) to (N, 4, 4)
    yaw = geometry.euler_from_quaternion(poses[:, 3:])[:, 2]

Quaternions are ``x, y, z, w``. Poses are ``x, y, z, qx, qy, qz, qw`` and named
``parent_from_child``. Matrices act on column vectors from the left.

=============  =========================================================
module         contents
=============  =========================================================
`conversions`  the functions of this package, which check their arguments
`quaternions`  one rotation, as plain tuples; no NumPy
`poses`        one pose, as plain tuples; tf2's arithmetic, no NumPy
`arrays`       rotations as NumPy arrays
=============  =========================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.geometry.conversions import (
        AXES,
        euler_from_quaternion,
        matrix_from_pose,
        matrix_from_quaternion,
        pose_from_matrix,
        quaternion_from_euler,
        quaternion_from_matrix,
    )

__all__ = [
    "AXES",
    "euler_from_quaternion",
    "matrix_from_pose",
    "matrix_from_quaternion",
    "pose_from_matrix",
    "quaternion_from_euler",
    "quaternion_from_matrix",
]


if not TYPE_CHECKING:  # a type checker would accept any name

    def __getattr__(name: str) -> object:
        # NumPy is loaded when arrays are converted; the core needs only plain tuples.
        if name not in __all__:
            raise AttributeError(f"module 'turtlewire.geometry' has no attribute {name!r}")
        from turtlewire.geometry import conversions

        value = globals()[name] = getattr(conversions, name)
        return value
