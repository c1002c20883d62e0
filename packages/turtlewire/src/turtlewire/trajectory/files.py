"""Trajectories in files: TUM, KITTI, EuRoC and CSV.

Stamps are written and read as integers (``seconds.nanoseconds``), so that no nanosecond is lost:
a double holds the seconds since 1970 only to 0.24 microseconds. Numbers are written so that they
read back as the same doubles. The formats do not store gaps: `find_gaps` derives them from pauses.
"""

from __future__ import annotations

import os
from decimal import Decimal, InvalidOperation
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.geometry import arrays
from turtlewire.trajectory.sampling import find_gaps
from turtlewire.trajectory.trajectory import Trajectory, as_stamps

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

__all__ = [
    "FORMATS",
    "kitti_times",
    "read_csv",
    "read_euroc",
    "read_kitti",
    "read_trajectory",
    "read_tum",
    "write_csv",
    "write_euroc",
    "write_kitti",
    "write_trajectory",
    "write_tum",
]

#: Formats of files, and the usual ending of their names.
FORMATS = {"tum": ".tum", "kitti": ".kitti", "euroc": ".euroc", "csv": ".csv"}

_SECOND = 1_000_000_000
#: Stamps are int64.
_LATEST_NS = (1 << 63) - 1


def read_tum(path: str | os.PathLike[str]) -> Trajectory:
    """Read ``timestamp tx ty tz qx qy qz qw``, seconds, separated by blanks.

    Raises:
        ValueError: A line is not like that; the text names it.
    """
    stamps, rows = _read_table(path, None, 8, "8 numbers: timestamp tx ty tz qx qy qz qw")
    return _with_gaps(_in_order(stamps, path), rows)


def write_tum(trajectory: Trajectory, path: str | os.PathLike[str]) -> None:
    """Write a TUM file; see `read_tum`."""
    times = map(_seconds, trajectory.stamps_ns.tolist())
    _write_lines(path, zip(times, trajectory.poses.tolist(), strict=True), " ")


def read_csv(path: str | os.PathLike[str]) -> Trajectory:
    """Read ``t_ns,x,y,z,qx,qy,qz,qw`` with integer nanoseconds; a heading begins with ``#`` or t.

    Raises:
        ValueError: A line is not like that; the text names it.
    """
    stamps, rows = _read_table(path, ",", 8, "8 numbers: t_ns,x,y,z,qx,qy,qz,qw", unit=1)
    return _with_gaps(_in_order(stamps, path), rows)


def write_csv(trajectory: Trajectory, path: str | os.PathLike[str]) -> None:
    """Write a CSV file with a heading; see `read_csv`."""
    times = map(str, trajectory.stamps_ns.tolist())
    heading = "t_ns,x,y,z,qx,qy,qz,qw\n"
    _write_lines(path, zip(times, trajectory.poses.tolist(), strict=True), ",", heading)


def read_euroc(path: str | os.PathLike[str]) -> Trajectory:
    """Read EuRoC's ground truth: ``t_ns,x,y,z,qw,qx,qy,qz`` and further columns, which are ignored.

    Raises:
        ValueError: A line is not like that; the text names it.
    """
    wanted = "at least 8 numbers: t_ns,x,y,z,qw,qx,qy,qz"
    stamps, rows = _read_table(path, ",", 8, wanted, unit=1, exact=False)
    return _with_gaps(_in_order(stamps, path), rows[:, [0, 1, 2, 4, 5, 6, 3]])


def write_euroc(trajectory: Trajectory, path: str | os.PathLike[str]) -> None:
    """Write EuRoC's ground truth with a heading; see `read_euroc`."""
    times = map(str, trajectory.stamps_ns.tolist())
    poses = trajectory.poses[:, [0, 1, 2, 6, 3, 4, 5]].tolist()
    heading = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n"
    _write_lines(path, zip(times, poses, strict=True), ",", heading)


def read_kitti(
    path: str | os.PathLike[str], times: str | os.PathLike[str] | None = None
) -> Trajectory:
    """Read KITTI's poses: the upper three rows of a matrix, row by row, 12 numbers a line.

    Args:
        path: The poses. KITTI's camera looks along z; nothing is turned here.
        times: A file with one time in seconds a line. Without it the stamps are 0, 1, 2 … s.

    Raises:
        ValueError: A line is not like that, or the files differ in length.
    """
    _, rows = _read_table(path, None, 12, "12 numbers: the rows of a 3x4 matrix", timed=False)
    matrices = rows.reshape(-1, 3, 4)
    poses = np.hstack((matrices[:, :, 3], arrays.from_matrices(matrices[:, :, :3])))
    if times is None:
        return Trajectory(np.arange(len(poses), dtype=np.int64) * _SECOND, poses, timed=False)
    stamps, _ = _read_table(times, None, 1, "one number: the time in seconds")
    if len(stamps) != len(poses):
        raise ValueError(f"{path} has {len(poses)} poses, {times} has {len(stamps)} times")
    return _with_gaps(_in_order(stamps, times), poses)


def write_kitti(
    trajectory: Trajectory,
    path: str | os.PathLike[str],
    times: str | os.PathLike[str] | None = None,
) -> None:
    """Write KITTI's poses and, into a second file if one is given, the times in seconds."""
    rows = trajectory.as_matrices()[:, :3].reshape(-1, 12).tolist()
    _write_lines(path, ((None, row) for row in rows), " ")
    if times is not None:
        stamps = trajectory.stamps_ns.tolist()
        _write_lines(times, ((_seconds(stamp), ()) for stamp in stamps), " ")


def kitti_times(path: str | os.PathLike[str]) -> str:
    """Return the file beside KITTI's poses that has their times."""
    return os.path.splitext(os.fspath(path))[0] + "_times.txt"


def write_trajectory(
    trajectory: Trajectory, path: str | os.PathLike[str], kind: str | None = None
) -> str:
    """Write a file of one of `FORMATS`; of KITTI's, the times go into ``<name>_times.txt``.

    Args:
        trajectory: What is written.
        path: Where to.
        kind: The format; None takes it from the ending of the name, TUM if that says nothing.

    Returns:
        The format.

    Raises:
        ValueError: The format does not exist.
    """
    _, ending = os.path.splitext(os.fspath(path))
    kind = kind or next((each for each, usual in FORMATS.items() if usual == ending), "tum")
    if kind == "kitti":
        write_kitti(trajectory, path, kitti_times(path))
        return kind
    writers = {"tum": write_tum, "euroc": write_euroc, "csv": write_csv}
    if kind not in writers:
        raise ValueError(f"unknown format '{kind}'; choose from {', '.join(FORMATS)}")
    writers[kind](trajectory, path)
    return kind


def read_trajectory(path: str | os.PathLike[str]) -> Trajectory:
    """Read a file of any of these formats: the separator and the columns determine the format.

    KITTI's times are read from ``<name>_times.txt``, if there is such a file.

    Raises:
        ValueError: The file has none of these formats, or no data.
    """
    with open(path, encoding="utf-8-sig") as file:
        lines = [line for line in (line.strip() for line in file) if line]
    data = next((line for line in lines if not _is_comment(line)), "")
    if not data:
        what = "only comments and words" if lines else "nothing"
        raise ValueError(
            f"{os.fspath(path)} is not a trajectory: it contains {what}, but no lines of numbers"
        )
    columns = len(data.split("," if "," in data else None))
    if "," not in data:
        if columns == 12:
            times = kitti_times(path)
            return read_kitti(path, times if os.path.exists(times) else None)
        return read_tum(path)
    euroc = columns > 8 or any(line.startswith("#") and "q_w" in line for line in lines[:1])
    return read_euroc(path) if euroc else read_csv(path)


def _read_table(
    path: str | os.PathLike[str],
    separator: str | None,
    columns: int,
    wanted: str,
    *,
    unit: int = _SECOND,
    exact: bool = True,
    timed: bool = True,
) -> tuple[list[int], NDArray[np.float64]]:
    """Stamps (if ``timed``) and the other columns of a text file."""
    stamps: list[int] = []
    rows: list[list[float]] = []
    with open(path, encoding="utf-8-sig") as file:
        for number, line in enumerate(file, start=1):
            if _is_comment(line) and not (rows and line.strip()[:1].isalpha()):
                continue  # words are a heading, which has its place above the numbers
            items = line.split(separator)
            try:
                if len(items) < columns or (exact and len(items) > columns):
                    raise ValueError(f"found {len(items)}")  # noqa: TRY301 - reported like the others
                if timed:
                    stamps.append(_nanoseconds(items[0].strip(), unit))
                rows.append([float(item) for item in items[timed:columns]])
            except ValueError as error:
                raise ValueError(
                    f"{os.fspath(path)}, line {number}: expected {wanted}; {error}"
                ) from None
    if not (rows or stamps):
        raise ValueError(f"{os.fspath(path)} has no data: expected lines of {wanted}")
    table = np.array(rows, dtype=np.float64).reshape(len(rows), columns - timed)
    infinite = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(infinite):
        raise ValueError(f"{os.fspath(path)}: pose {infinite[0]} has a number that is not finite")
    return stamps, table


def _is_comment(line: str) -> bool:
    text = line.strip()
    return not text or text.startswith("#") or text[:1].isalpha()


def _seconds(stamp_ns: int) -> str:
    sign = "-" if stamp_ns < 0 else ""
    return f"{sign}{abs(stamp_ns) // _SECOND}.{abs(stamp_ns) % _SECOND:09d}"


def _nanoseconds(text: str, unit: int) -> int:
    """Return a time in nanoseconds, ``unit`` of which make 1; without going through float."""
    try:
        stamp_ns = int(Decimal(text) * unit)
    except (InvalidOperation, ValueError, OverflowError):
        raise ValueError(f"'{text}' is not a time") from None
    if abs(stamp_ns) > _LATEST_NS:
        said = "seconds are expected here: is it in nanoseconds?" if unit == _SECOND else ""
        raise ValueError(f"the time '{text}' is beyond the year 2262; {said}".rstrip("; "))
    return stamp_ns


def _in_order(stamps: list[int], path: str | os.PathLike[str]) -> NDArray[np.int64]:
    try:
        return as_stamps(np.array(stamps, dtype=np.int64))
    except (ValueError, OverflowError) as error:
        raise ValueError(f"{os.fspath(path)}: {error}") from None


def _with_gaps(stamps: NDArray[np.int64], poses: NDArray[np.float64]) -> Trajectory:
    return Trajectory(stamps, poses, gaps=tuple(find_gaps(stamps)))


def _write_lines(
    path: str | os.PathLike[str],
    rows: Iterable[tuple[str | None, Sequence[float]]],
    separator: str,
    heading: str = "",
) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(heading)
        for time, numbers in rows:
            items = ([] if time is None else [time]) + [repr(number) for number in numbers]
            file.write(separator.join(items) + "\n")
