"""Trajectories in files: TUM, KITTI, EuRoC and CSV.

Stamps are written and read as integers (``seconds.nanoseconds``), so that no nanosecond is lost: a
double holds the seconds since 1970 only to 0.24 microseconds. Numbers are written so that reading
them gives the same doubles. The formats do not store gaps: `Trajectory.load` derives them from
pauses. Repeated stamps and quaternions that are not unit quaternions are accepted; a remark reports
the correction.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Sequence
from decimal import Decimal, InvalidOperation
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from turtlewire.geometry import arrays
from turtlewire.new_file import new_file
from turtlewire.path_arguments import BAGS, PICTURES, missing_file, path_text, refuse_other_formats
from turtlewire.trajectory.stamps import Gap, find_gaps
from turtlewire.wording import counted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Stamps = NDArray[np.int64]
    Poses = NDArray[np.float64]

__all__ = ["FORMATS", "FileContents", "Format", "kitti_times", "read_file", "write_file"]

Format = Literal["tum", "kitti", "euroc", "csv"]

#: Formats of files, and the usual ending of their names.
FORMATS: dict[str, str] = {"tum": ".tum", "kitti": ".kitti", "euroc": ".euroc", "csv": ".csv"}
_INSTEAD = {
    PICTURES: "trajectory.plot().save(path) draws it as .svg, .pdf or .png",
    BAGS: "turtlewire.bag.BagWriter writes bags",
    (".npz", ".npy"): "np.savez(path, stamps_ns=trajectory.stamps_ns, poses=trajectory.poses) does",
}

_SECOND = 1_000_000_000
#: Quaternions that are written with four digits or more differ by less from the length 1.
_ROUNDING = 1e-3
#: Clock times in seconds, from 2001 to 2286.
_SECONDS_SINCE_1970 = (10**9, 10**10)
#: Stamps are int64.
_LATEST_NS = (1 << 63) - 1


class FileContents(NamedTuple):
    """The contents of a file; see `Trajectory` for the first four.

    ``remarks`` say what differs from the file.
    """

    stamps_ns: NDArray[np.int64]
    poses: NDArray[np.float64]
    gaps: tuple[Gap, ...] = ()
    timed: bool = True
    remarks: tuple[str, ...] = ()


def _read_tum(path: str | os.PathLike[str]) -> FileContents:
    """Read ``timestamp tx ty tz qx qy qz qw``, seconds, separated by blanks.

    Raises:
        ValueError: A line is not like that; the text names it.
    """
    wanted = "8 numbers, separated by blanks: timestamp tx ty tz qx qy qz qw"
    stamps, rows = _read_table(path, None, 8, wanted)
    return _contents(stamps, rows, path)


def _write_tum(stamps: Stamps, poses: Poses, path: str | os.PathLike[str]) -> None:
    """Write a TUM file; see `_read_tum`."""
    times = map(_seconds, stamps.tolist())
    _write_lines(path, zip(times, poses.tolist(), strict=True), " ")


def _read_csv(path: str | os.PathLike[str]) -> FileContents:
    """Read ``t_ns,x,y,z,qx,qy,qz,qw`` with integer nanoseconds; a heading begins with ``#`` or t.

    Raises:
        ValueError: A line is not like that; the text names it.
    """
    stamps, rows = _read_table(path, ",", 8, "8 numbers: t_ns,x,y,z,qx,qy,qz,qw", unit=1)
    return _contents(stamps, rows, path, unit=1)


def _write_csv(stamps: Stamps, poses: Poses, path: str | os.PathLike[str]) -> None:
    """Write a CSV file with a heading; see `_read_csv`."""
    times = map(str, stamps.tolist())
    heading = "t_ns,x,y,z,qx,qy,qz,qw\n"
    _write_lines(path, zip(times, poses.tolist(), strict=True), ",", heading)


def _read_euroc(path: str | os.PathLike[str]) -> FileContents:
    """Read EuRoC's ground truth: ``t_ns,x,y,z,qw,qx,qy,qz`` and further columns, which are ignored.

    Raises:
        ValueError: A line is not like that; the text names it.
    """
    wanted = "at least 8 numbers: t_ns,x,y,z,qw,qx,qy,qz"
    stamps, rows = _read_table(path, ",", 8, wanted, unit=1, exact=False)
    return _contents(stamps, rows[:, [0, 1, 2, 4, 5, 6, 3]], path, unit=1)


def _write_euroc(stamps: Stamps, poses: Poses, path: str | os.PathLike[str]) -> None:
    """Write EuRoC's ground truth with a heading; see `_read_euroc`."""
    times = map(str, stamps.tolist())
    rows = poses[:, [0, 1, 2, 6, 3, 4, 5]].tolist()
    heading = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n"
    _write_lines(path, zip(times, rows, strict=True), ",", heading)


def _read_kitti(
    path: str | os.PathLike[str], times: str | os.PathLike[str] | None = None
) -> FileContents:
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
        return FileContents(np.arange(len(poses), dtype=np.int64) * _SECOND, poses, timed=False)
    stamps, _ = _read_table(times, None, 1, "one number: the time in seconds")
    if len(stamps) != len(poses):
        raise ValueError(
            f"{path} has {counted(len(poses), 'pose')}, {times} has {counted(len(stamps), 'time')}"
        )
    return _contents(stamps, poses, times)


def _read_kitti_alone(path: str | os.PathLike[str]) -> FileContents:
    """Read KITTI's poses, with the times of the file next to them if it exists."""
    if os.path.exists(kitti_times(path)):
        return _read_kitti(path, kitti_times(path))
    of_sequence = os.path.join(os.path.dirname(os.fspath(path)), "times.txt")
    if not os.path.exists(of_sequence):
        return _read_kitti(path)
    try:
        found = _read_kitti(path, of_sequence)
    except ValueError as error:  # they may belong to another sequence
        found, remark = _read_kitti(path), f"times.txt is not used: {error}"
    else:
        remark = f"{os.fspath(path)}: the times come from times.txt in the same folder"
    return found._replace(remarks=(*found.remarks, remark))


def _write_kitti(stamps: Stamps, poses: Poses, path: str | os.PathLike[str]) -> None:
    """Write KITTI's poses and, into a second file, the times in seconds."""
    matrices = np.dstack((arrays.matrices(poses[:, 3:]), poses[:, :3]))
    _write_lines(path, ((None, row) for row in matrices.reshape(-1, 12).tolist()), " ")
    times = ((_seconds(stamp), ()) for stamp in stamps.tolist())
    _write_lines(kitti_times(path), times, " ")


def kitti_times(path: str | os.PathLike[str]) -> str:
    """Return the file next to KITTI's poses that contains their times."""
    return os.path.splitext(os.fspath(path))[0] + "_times.txt"


def write_file(
    stamps: Stamps, poses: Poses, path: str | os.PathLike[str], kind: Format | None = None
) -> str:
    """Write a file and return its format; see `Trajectory.save`."""
    path = path_text(path, what="name of the file")
    if kind is None:
        written = "a trajectory is saved as .tum, .kitti, .euroc or .csv"
        refuse_other_formats(path, tuple(FORMATS.values()), written, _INSTEAD)
    ending = os.path.splitext(os.fspath(path))[1].lower()
    chosen: str = kind or next((each for each, usual in FORMATS.items() if usual == ending), "tum")
    writers = {"tum": _write_tum, "kitti": _write_kitti, "euroc": _write_euroc, "csv": _write_csv}
    writers[_known(chosen)](stamps, poses, path)
    return chosen


def read_file(
    path: str | os.PathLike[str],
    kind: Format | None = None,
    times: str | os.PathLike[str] | None = None,
) -> FileContents:
    """Read a file; see `Trajectory.load`."""
    path = path_text(path, what="path of a trajectory")
    if os.path.isdir(path):
        text = "a trajectory is a file; to read a bag, call Trajectory.from_bag"
        raise IsADirectoryError(errno.EISDIR, text, path)
    if not os.path.exists(path):
        raise missing_file(path)
    try:
        return _read_file(path, kind, times)
    except UnicodeDecodeError:
        raise ValueError(
            f"{path} is not a trajectory, because it is not text; to read a bag, call "
            "Trajectory.from_bag"
        ) from None


def _read_file(
    path: str | os.PathLike[str], kind: Format | None, times: str | os.PathLike[str] | None
) -> FileContents:
    chosen = _format_of(path) if kind is None else _known(kind)
    if chosen == "kitti":
        return _read_kitti(path, times) if times is not None else _read_kitti_alone(path)
    if times is not None:
        raise ValueError(
            f"{os.fspath(path)} has the format '{chosen}', whose lines begin with the time; leave "
            "out `times`, which is for the format 'kitti'"
        )
    return {"tum": _read_tum, "euroc": _read_euroc, "csv": _read_csv}[chosen](path)


def _known(kind: str) -> str:
    if kind not in FORMATS:
        raise ValueError(f"unknown format '{kind}'; choose from {', '.join(FORMATS)}")
    return kind


def _format_of(path: str | os.PathLike[str]) -> str:
    """Return the format of a file's suffix; without one, what separator and columns show.

    ``.csv`` is also the usual suffix of EuRoC's files, and says less than the columns.
    """
    suffix = os.path.splitext(path)[1].lower()
    named = next((each for each, usual in FORMATS.items() if usual == suffix != ".csv"), None)
    with open(path, encoding="utf-8-sig") as file:
        lines = [line for line in (line.strip() for line in file) if line]
    data = next((line for line in lines if not _is_comment(line)), "")
    if not data:
        what = "only comments and words" if lines else "nothing"
        raise ValueError(
            f"{os.fspath(path)} is not a trajectory: it contains {what}, but no lines of numbers"
        )
    if named is not None:
        _check_separator(path, named, data)
        return named
    columns = len(data.split("," if "," in data else None))
    if "," not in data:
        return "kitti" if columns == 12 else "tum"
    return "euroc" if columns > 8 or _begins_with_w(lines[0]) else "csv"


def _begins_with_w(heading: str) -> bool:
    """Return whether the columns of a heading have w of the quaternion before x, as EuRoC's."""
    names = [name.split()[0] for name in heading.lower().lstrip("#").split(",") if name.strip()]
    places = {
        axis: [n for n, name in enumerate(names) if name in (f"q{axis}", f"q_{axis}")]
        for axis in "wx"
    }
    return bool(places["w"]) and places["w"] < (places["x"] or [len(names)])


def _check_separator(path: str | os.PathLike[str], named: str, data: str) -> None:
    """Raise ValueError if a line of numbers has the separator of other formats than the named."""
    if ("," in data) == (named == "euroc"):
        return
    found, right = ("commas", "blanks") if "," in data else ("blanks", "commas")
    others = "'csv' or 'euroc'" if found == "commas" else "'tum' or 'kitti'"
    raise ValueError(
        f"{os.fspath(path)} has numbers separated by {found}, but the format of its name, "
        f"'{named}', has {right}; pass the format that it has, {others}, as `format`, or replace "
        f"the {found} by {right}"
    )


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
                continue  # words are a heading, which must precede the numbers
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
        exact = Decimal(text) * unit
        stamp_ns = int(exact)
    except (InvalidOperation, ValueError, OverflowError):
        raise ValueError(f"'{text}' is not a time") from None
    if unit == 1 and stamp_ns != exact:
        raise ValueError(f"the time '{text}' is not a whole number of nanoseconds")
    if abs(stamp_ns) > _LATEST_NS:
        said = "seconds are expected here: is it in nanoseconds?" if unit == _SECOND else ""
        raise ValueError(f"the time '{text}' is beyond the year 2262; {said}".rstrip("; "))
    return stamp_ns


def _contents(
    stamps: list[int],
    poses: NDArray[np.float64],
    path: str | os.PathLike[str],
    *,
    unit: int = _SECOND,
) -> FileContents:
    """Keep the first pose of each stamp, and bring the quaternions to the length 1."""
    array = np.array(stamps, dtype=np.int64)
    back = np.flatnonzero(array[1:] < array[:-1])
    if len(back):
        row = int(back[0])
        raise ValueError(
            f"{os.fspath(path)}: stamps must increase; stamp {row + 1} does not follow stamp "
            f"{row}; sort the lines of the file"
        )
    lengths = arrays.lengths(poses[:, 3:])
    if not lengths.all():
        row = int(np.flatnonzero(lengths == 0)[0])
        raise ValueError(f"{os.fspath(path)}: the quaternion of pose {row} has the length 0")
    first = np.concatenate(([True], array[1:] != array[:-1]))
    remarks = [
        f"{os.fspath(path)}: {count:,} of {len(array):,} {what}"
        for count, what in (
            (np.count_nonzero(~first), "stamps repeat the previous one; the first pose is used"),
            (np.count_nonzero(np.abs(lengths - 1.0) > _ROUNDING), "quaternions are normalised"),
        )
        if count
    ]
    poses = np.hstack((poses[:, :3], arrays.normalised(poses[:, 3:])))
    kept = array[first]
    least, most = _SECONDS_SINCE_1970
    if unit == 1 and len(kept) > 1 and least <= kept[0] and kept[-1] < most:
        remarks.append(
            f"{os.fspath(path)}: stamps such as {kept[0]} are read as nanoseconds: are they "
            "seconds? The format with seconds is 'tum', separated by blanks"
        )
    return FileContents(kept, poses[first], tuple(find_gaps(kept)), remarks=tuple(remarks))


def _write_lines(
    path: str | os.PathLike[str],
    rows: Iterable[tuple[str | None, Sequence[float]]],
    separator: str,
    heading: str = "",
) -> None:
    with new_file(path) as unfinished, open(unfinished, "w", encoding="utf-8") as file:
        file.write(heading)
        for time, numbers in rows:
            items = ([] if time is None else [time]) + [repr(number) for number in numbers]
            file.write(separator.join(items) + "\n")
