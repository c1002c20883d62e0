"""Results of a buffer that have several parts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["FramePoses", "Samples"]


class FramePoses(NamedTuple):
    """The poses of all frames in one frame at one time."""

    frames: list[str]
    poses: NDArray[np.float64]
    """x, y, z, qx, qy, qz, qw for each frame, shape (N, 7)."""
    stamps_ns: NDArray[np.int64]
    """The time of each pose; NaT's value for a pose that holds at all times."""


class Samples(NamedTuple):
    """The samples of a frame in one parent, oldest first."""

    parent_frame: str
    stamps_ns: NDArray[np.int64]
    poses: NDArray[np.float64]
    """x, y, z, qx, qy, qz, qw for each stamp, shape (N, 7)."""
