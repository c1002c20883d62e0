"""A trajectory: the poses of one frame in another over time."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire.geometry import arrays

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.trajectory.chart import Plot

__all__ = ["Gap", "Trajectory", "as_stamps"]


class Gap(NamedTuple):
    """A time without data, in nanoseconds: from the last sample before it to the first after it."""

    start_ns: int
    end_ns: int


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses over time.

    Attributes:
        stamps_ns: (N,) int64, nanoseconds since 1970, increasing.
        poses: (N, 7) float64: x, y, z in metres and the unit quaternion x, y, z, w.
        frame_id: The frame in which the poses are given; empty if it is not known.
        child_frame_id: The frame that moves; empty if it is not known.
        gaps: Times without data; there are no poses within them.
        timed: False if the stamps only count the poses, as in a KITTI file without times.

    Raises:
        ValueError: The arrays do not fit together, or hold no unit quaternions.
    """

    stamps_ns: NDArray[np.int64]
    poses: NDArray[np.float64]
    frame_id: str = ""
    child_frame_id: str = ""
    gaps: tuple[Gap, ...] = field(default=())
    timed: bool = True

    def __post_init__(self) -> None:
        stamps = as_stamps(self.stamps_ns)
        poses = np.ascontiguousarray(self.poses, dtype=np.float64)
        if poses.shape != (len(stamps), 7):
            raise ValueError(
                f"expected poses of shape ({len(stamps)}, 7), one for each stamp; got {poses.shape}"
            )
        lengths = np.linalg.norm(poses[:, 3:], axis=1)
        if not np.all(np.abs(lengths - 1.0) < 1e-3):  # also false for NaN
            row = int(np.flatnonzero(~(np.abs(lengths - 1.0) < 1e-3))[0])
            raise ValueError(f"the quaternion of pose {row} has the length {lengths[row]}, not 1")
        object.__setattr__(self, "stamps_ns", stamps)
        object.__setattr__(self, "poses", poses)

    def __len__(self) -> int:
        return len(self.stamps_ns)

    def __getitem__(self, rows: slice | NDArray[Any]) -> Trajectory:
        """Return the poses of a slice or of an index array.

        Raises:
            TypeError: ``rows`` is a single number: use ``stamps_ns[i]`` and ``poses[i]``.
        """
        if isinstance(rows, (int, np.integer)):
            raise TypeError(f"expected a slice or an index array; pose {rows} is poses[{rows}]")
        return replace(self, stamps_ns=self.stamps_ns[rows], poses=self.poses[rows])

    def __repr__(self) -> str:
        what = f"'{self.child_frame_id}' in '{self.frame_id}', " if self.child_frame_id else ""
        gaps = "1 gap" if len(self.gaps) == 1 else f"{len(self.gaps)} gaps"
        return (
            f"<Trajectory: {what}{len(self)} poses, {self.duration_ns / 1e9:.3f} s, "
            f"{self.path_length:.3f} m{f', {gaps}' if self.gaps else ''}>"
        )

    @property
    def positions(self) -> NDArray[np.float64]:
        """(N, 3) in metres."""
        return self.poses[:, :3]

    @property
    def rotations(self) -> NDArray[np.float64]:
        """(N, 4) unit quaternions x, y, z, w."""
        return self.poses[:, 3:]

    @property
    def duration_ns(self) -> int:
        """From the first to the last pose."""
        return int(self.stamps_ns[-1] - self.stamps_ns[0]) if len(self) else 0

    @property
    def distances(self) -> NDArray[np.float64]:
        """(N,) the length of the path up to each pose, in metres."""
        steps = np.linalg.norm(np.diff(self.positions, axis=0), axis=1)
        return np.concatenate(([0.0], np.cumsum(steps))) if len(self) else np.zeros(0)

    @property
    def path_length(self) -> float:
        """The length of the path in metres."""
        return float(self.distances[-1]) if len(self) else 0.0

    @property
    def euler(self) -> NDArray[np.float64]:
        """(N, 3) roll, pitch, yaw in radians, without jumps by full turns."""
        return np.unwrap(arrays.euler(self.rotations), axis=0)

    @property
    def speeds(self) -> NDArray[np.float64]:
        """(N - 1,) mean speed between successive poses in m/s."""
        seconds = np.diff(self.stamps_ns) / 1e9
        steps = np.linalg.norm(np.diff(self.positions, axis=0), axis=1)
        speeds: NDArray[np.float64] = steps / seconds
        return speeds

    def as_matrices(self) -> NDArray[np.float64]:
        """(N, 4, 4) homogeneous matrices, acting on column vectors from the left."""
        matrices = np.tile(np.eye(4), (len(self), 1, 1))
        matrices[:, :3, :3] = arrays.matrices(self.rotations)
        matrices[:, :3, 3] = self.positions
        return matrices

    def plot(self, kind: str = "path", reference: Trajectory | None = None) -> Plot:
        """Return a picture: ``path`` (x and y), ``positions``, ``angles`` or ``speeds`` over time.

        Args:
            kind: What is drawn.
            reference: Drawn dashed and grey.

        Raises:
            ValueError: The kind of plot does not exist, or the trajectory is empty.
        """
        from turtlewire.trajectory import plots

        drawn = {
            "path": plots.plot_path,
            "positions": plots.plot_positions,
            "angles": plots.plot_angles,
            "speeds": plots.plot_speeds,
        }
        if kind not in drawn:
            raise ValueError(f"'{kind}' is not a kind of plot; choose from {', '.join(drawn)}")
        return drawn[kind](self, reference)

    def _repr_svg_(self) -> str | None:
        return self.plot().svg if len(self) else None

    def to_pandas(self) -> Any:
        """Return a pandas ``DataFrame``: index UTC time, columns x y z qx qy qz qw roll pitch yaw.

        Raises:
            ImportError: pandas is not installed.
        """
        import pandas as pd

        columns = ["x", "y", "z", "qx", "qy", "qz", "qw", "roll", "pitch", "yaw"]
        index = pd.to_datetime(self.stamps_ns, unit="ns", utc=True)
        return pd.DataFrame(np.hstack((self.poses, self.euler)), index=index, columns=columns)


def as_stamps(stamps: ArrayLike) -> NDArray[np.int64]:
    """Times as nanoseconds since 1970.

    Args:
        stamps: Integers (nanoseconds) or ``datetime64``, shape (N,).

    Returns:
        (N,) int64.

    Raises:
        TypeError: The array holds something else. Floats are refused: a double holds the seconds
            since 1970 only to 0.24 microseconds.
        ValueError: The array has not one dimension, or does not increase.
    """
    array = np.asarray(stamps)
    if array.dtype.kind == "M":
        array = array.astype("datetime64[ns]").astype(np.int64)
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"expected stamps in integer nanoseconds or datetime64, got {array.dtype}")
    if array.ndim != 1:
        raise ValueError(f"expected stamps of shape (N,), got {array.shape}")
    array = np.ascontiguousarray(array, dtype=np.int64)
    back = np.flatnonzero(array[1:] <= array[:-1])
    if len(back):
        row = int(back[0])
        raise ValueError(f"stamps must increase; stamp {row + 1} does not follow stamp {row}")
    return array
