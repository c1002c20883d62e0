"""A trajectory: the poses of one frame in another over time."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.call_errors import explain_calls, hint_at
from turtlewire.geometry import arrays
from turtlewire.tf.array_arguments import number_array
from turtlewire.trajectory.stamps import Gap, as_stamps
from turtlewire.wording import counted

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from turtlewire.tf.datetimes import Span, Stamp
    from turtlewire.trajectory.chart import Plot
    from turtlewire.trajectory.files import Format
    from turtlewire.trajectory.plots import Kind

__all__ = ["Trajectory"]


@hint_at(
    {
        "positions_xyz xyz translations": "positions, (N, 3)",
        "orientations_quat_wxyz orientations quaternions": "rotations, (N, 4): x, y, z, w",
        "orientations_euler": "euler, (N, 3): roll, pitch, yaw",
        "timestamps times stamps t": "stamps_ns",
        "poses_se3 matrices": "as_matrices()",
        "length": "path_length",
        "duration": "duration_ns",
        "velocities": "speeds",
        "ape rpe ate rmse align": "turtlewire.trajectory.compare(reference, trajectory)",
        "from_tum from_file read": "Trajectory.load(path)",
        "to_tum to_csv write": "save(path), whose ending chooses the format",
        "dataframe df": "to_pandas()",
    }
)
@explain_calls
@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses over time.

    Attributes:
        stamps_ns: (N,) int64, nanoseconds since 1970, increasing.
        poses: (N, 7) float64: x, y, z in metres and the unit quaternion x, y, z, w. Lengths
            between 0.999 and 1.001 are accepted, and corrected to 1.
        target_frame: The frame in which the poses are given; empty if it is not known.
        source_frame: The frame that moves; empty if it is not known.
        gaps: Times without data; there are no poses within them.
        timed: False if the stamps only count the poses, as in a KITTI file without times.

    Raises:
        ValueError: The arrays do not fit together, or hold no unit quaternions.
    """

    stamps_ns: NDArray[np.int64]
    poses: NDArray[np.float64]
    target_frame: str = ""
    source_frame: str = ""
    gaps: tuple[Gap, ...] = field(default=())
    timed: bool = True

    def __post_init__(self) -> None:
        stamps = as_stamps(self.stamps_ns)
        poses = _checked_poses(self.poses, len(stamps))
        rotations = poses[:, 3:]
        unit = arrays.normalised(rotations)
        if unit is not rotations:
            poses = np.hstack((poses[:, :3], unit))
        object.__setattr__(self, "stamps_ns", stamps)
        object.__setattr__(self, "poses", poses)

    @classmethod
    def load(
        cls,
        path: str | os.PathLike[str],
        *,
        format: Format | None = None,  # noqa: A002 - the word of users
        times: str | os.PathLike[str] | None = None,
    ) -> Trajectory:
        """Read a file.

        The formats are TUM (``timestamp tx ty tz qx qy qz qw`` in seconds), KITTI (12 numbers of a
        3x4 matrix a line), EuRoC (``t_ns,x,y,z,qw,qx,qy,qz`` and further columns, which are
        ignored) and CSV (``t_ns,x,y,z,qx,qy,qz,qw``).

        Of poses with the same stamp the first is taken, and quaternions are normalised. A
        ``UserWarning`` says how many there were; lengths between 0.999 and 1.001 are rounding and
        are not counted.

        Args:
            path: The file.
            format: Its format; None derives it from the suffix ``.tum``, ``.kitti`` or ``.euroc``,
                and otherwise from the separator and the columns.
            times: A file with the times of a KITTI file, one time in seconds a line. None reads
                ``<name>_times.txt``, or ``times.txt`` with as many times as there are poses, in
                the same folder. If there is neither, the stamps are 0, 1, 2 … s.

        Raises:
            FileNotFoundError: ``path`` does not exist.
            IsADirectoryError: ``path`` is a folder, for example a bag.
            ValueError: The file has another format, or no data. The text names the line.
        """
        from turtlewire.trajectory.files import read_file

        found = read_file(path, format, times)
        for remark in found.remarks:
            warnings.warn(remark, stacklevel=3)
        return cls(found.stamps_ns, found.poses, gaps=found.gaps, timed=found.timed)

    @classmethod
    def from_bag(
        cls,
        path: str | os.PathLike[str],
        topic: str,
        *,
        start_ns: Stamp | None = None,
        end_ns: Stamp | None = None,
        max_gap_ns: Span | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> Trajectory:
        """Read the poses of a topic of a bag, with the stamps of their headers.

        Poses come in order of their stamps. Of poses with the same stamp the first is taken.

        Args:
            path: The bag; see `turtlewire.bag.open_bag`.
            topic: A topic with odometry, or with poses or transforms that have a header.
            start_ns: When the first message to take was received.
            end_ns: When the last message to take was received.
            max_gap_ns: Longer pauses are gaps; None uses ten times the median pause, and at least
                half a second.
            progress: Called with the share that was read; by default a line is drawn on a terminal.

        Raises:
            FileNotFoundError: ``path`` does not exist.
            BagError: ``path`` is not a bag, or the topic is missing or has another type. The hint
                lists the topics with poses.
            ValueError: A quaternion is invalid, or ``end_ns`` is before ``start_ns``.
        """
        from turtlewire.bag.trajectories import read_topic  # bags are above trajectories

        return cls(*read_topic(path, topic, (start_ns, end_ns), max_gap_ns, progress))

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        format: Format | None = None,  # noqa: A002 - the word of users
    ) -> None:
        """Write a file; see `load` for the formats.

        Stamps are written as integers and numbers so that they read back as the same doubles. The
        times of a KITTI file go into ``<name>_times.txt``.

        Args:
            path: The file.
            format: Its format; None derives it from the suffix ``.tum``, ``.kitti``, ``.euroc`` or
                ``.csv``, and TUM for names without a suffix or with an unknown one.

        Raises:
            ValueError: The format does not exist, or the name ends in the suffix of a format that
                is not written, for example ``.png``.
        """
        from turtlewire.trajectory.files import write_file

        write_file(self.stamps_ns, self.poses, path, format)

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
        what = f"'{self.source_frame}' in '{self.target_frame}', " if self.source_frame else ""
        gaps = f", {counted(len(self.gaps), 'gap')}" if self.gaps else ""
        return (
            f"<Trajectory: {what}{counted(len(self), 'pose')}, {self.duration_ns / 1e9:.3f} s, "
            f"{self.path_length:.3f} m{gaps}>"
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
        """The time from the first to the last pose."""
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

    def plot(
        self, kind: Kind = "path", *, reference: Trajectory | None = None, plane: str = "xy"
    ) -> Plot:
        """Return a plot of this trajectory; `turtlewire.trajectory.plot` draws several.

        Args:
            kind: ``path`` (two axes of the positions), or ``positions``, ``angles`` or ``speeds``
                over time.
            reference: A trajectory drawn dashed and grey.
            plane: The axes of ``path``: ``xy``, ``xz``, ``yz`` or the other way round.

        Raises:
            ValueError: The kind of plot or the plane does not exist, or there is no pose.
        """
        from turtlewire.trajectory.plots import plot_trajectories

        named = {self.source_frame or "trajectory": self}
        return plot_trajectories(named, kind, reference, plane)

    def _repr_svg_(self) -> str | None:
        return self.plot().svg if len(self) else None

    def to_pandas(self) -> Any:
        """Return a pandas ``DataFrame``: index UTC time, columns x y z qx qy qz qw roll pitch yaw.

        Raises:
            ImportError: pandas is not installed.
        """
        try:
            import pandas as pd
        except ModuleNotFoundError as error:
            raise ModuleNotFoundError(
                "to_pandas needs the package pandas: pip install pandas", name=error.name
            ) from None
        columns = ["x", "y", "z", "qx", "qy", "qz", "qw", "roll", "pitch", "yaw"]
        index = pd.to_datetime(self.stamps_ns, unit="ns", utc=True)
        return pd.DataFrame(np.hstack((self.poses, self.euler)), index=index, columns=columns)


def _checked_poses(given: Any, count: int) -> NDArray[np.float64]:
    """Return poses as an array (count, 7).

    Raises:
        TypeError: An element is not a number.
        ValueError: The shape is another, a number is not finite or a quaternion has another length.
    """
    poses = np.ascontiguousarray(number_array(given, "poses"), dtype=np.float64)
    if poses.shape != (count, 7):
        remedies = {
            (3,): "; add rotations: np.hstack((positions, quaternions)), each x, y, z, w",
            (8,): "; leave out the column of the stamps: poses[:, 1:]",
            (4, 4): "; write geometry.pose_from_matrix(matrices)",
        }
        raise ValueError(
            f"expected poses of shape ({count}, 7), one for each stamp; got {poses.shape}"
            f"{remedies.get(poses.shape[1:], '')}"
        )
    strange = np.flatnonzero(~np.isfinite(poses).all(axis=1))
    if len(strange):
        raise ValueError(
            f"pose {strange[0]} has a number that is not finite; leave out such rows: "
            "known = np.isfinite(poses).all(axis=1)"
        )
    lengths = arrays.lengths(poses[:, 3:])
    strange = np.flatnonzero(np.abs(lengths - 1.0) >= 1e-3)
    if len(strange):
        raise ValueError(
            f"the quaternion of pose {strange[0]} has the length {lengths[strange[0]]}, not 1; the "
            "columns are x, y, z and the unit quaternion x, y, z, w"
        )
    return poses
