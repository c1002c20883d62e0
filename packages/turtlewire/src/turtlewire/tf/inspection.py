"""What a buffer has received: senders and rates of links, refused transforms, and conflicts.

Also saves a buffer to a file and loads it again.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.tf.links import LinkInfo, Sender, links

if TYPE_CHECKING:
    from os import PathLike
    from typing import BinaryIO
    from zipfile import ZipFile

    from numpy.typing import NDArray

    from turtlewire.tf.buffer import Buffer

__all__ = [
    "Conflict",
    "LinkInfo",
    "Malformed",
    "Refused",
    "Sender",
    "conflicts",
    "dumps",
    "links",
    "load",
    "loads",
    "malformed",
    "refusals",
    "save",
]

_FORMAT = "turtlewire buffer 1"
#: Equal poses shrink to a thousandth, but stamps only to a third: no buffer reaches this ratio.
_MOST_UNPACKED = 200
_ALWAYS_UNPACKED = 1_000_000  # bytes; files with a few static transforms


class Refused(NamedTuple):
    """What was refused of one child frame."""

    counts: dict[str, int]
    """Counts by reason.

    The reasons are self_transform, no_child_frame, no_parent_frame, nan_value, old_data,
    reserved_name, bad_name and too_many_frames.
    """
    last: str
    """The reason of the last one in tf2's words."""


class Malformed(NamedTuple):
    """Messages of which nothing could be taken, because the bytes are no ``TFMessage``."""

    messages: int
    last: str
    """What was wrong with the last one; empty if there was none."""
    sender: str
    """Who sent that one."""


class Conflict(NamedTuple):
    """Senders of one frame who contradict each other."""

    kind: str
    """``two publishers`` or ``two parents``."""
    child_frame: str
    text: str


def refusals(buffer: Buffer) -> dict[str, Refused]:
    """Return the rejected transforms by child frame; beyond 1000, the rest is ``(others)``."""
    return {
        child: Refused(counts, last)
        for child, (counts, last) in buffer._describe_refusals().items()
    }


def malformed(buffer: Buffer) -> Malformed:
    """Return the number of malformed messages, and the last one's error."""
    return Malformed(*buffer._describe_malformed())


def conflicts(buffer: Buffer) -> list[Conflict]:
    """Frames that more than one sender moves, or that go back and forth between parents.

    A sender counts as long as it has sent something within the history that the buffer keeps of the
    link. A frame that is handed over once from one parent to another, as when a gripper takes a
    part, is no conflict.
    """
    found = []
    for link in links(buffer):
        active = [
            sender for sender in link.senders if link.static or sender.newest_ns >= link.oldest_ns
        ]
        names = sorted({sender.name for sender in active})
        parents = sorted({sender.parent_frame for sender in active})
        if len(names) > 1:
            text = (
                f"'{link.child_frame}' is sent by {' and '.join(map(repr, names))}; "
                "each frame should have one publisher."
            )
            found.append(Conflict("two publishers", link.child_frame, text))
        # As many changes as parents: it has come back to one of them.
        if len(parents) > 1 and (link.static or link.parent_changes >= len(parents)):
            both = " and ".join(map(repr, parents))
            text = (
                f"'{link.child_frame}' goes back and forth between the parents {both}; "
                "a frame has one parent."
            )
            found.append(Conflict("two parents", link.child_frame, text))
    return found


def save(buffer: Buffer, path: str | PathLike[str]) -> None:
    """Write all samples and static transforms to a file.

    The format is NumPy's ``.npz``, without pickled objects.
    """
    with open(path, "wb") as file:
        _write(buffer, file)


def dumps(buffer: Buffer) -> bytes:
    """Return the bytes that :func:`save` writes."""
    import io

    file = io.BytesIO()
    _write(buffer, file)
    return file.getvalue()


def _write(buffer: Buffer, file: BinaryIO) -> None:
    import json

    import numpy as np

    from turtlewire.errors import LookupException

    arrays: dict[str, Any] = {}
    runs: list[tuple[str, str, bool, str]] = []
    for link in links(buffer):
        sender = link.senders[-1].name if link.senders else ""
        try:
            history = buffer.samples(link.child_frame)
        except LookupException:  # removed since the links were listed
            continue
        for parent, stamps, poses in history:
            arrays[f"stamps{len(runs)}"], arrays[f"poses{len(runs)}"] = stamps, poses
            runs.append((parent, link.child_frame, link.static, sender))
    header = json.dumps({"format": _FORMAT, "cache_time_ns": buffer.cache_time_ns, "runs": runs})
    np.savez_compressed(file, header=np.frombuffer(header.encode(), dtype=np.uint8), **arrays)


def load(path: str | PathLike[str]) -> Buffer:
    """Return a new buffer with what ``save`` wrote.

    Memory and time stay in proportion to the size of the file, whatever it contains.

    Raises:
        ValueError: The file is something else, or damaged.
    """
    with open(path, "rb") as file:
        return _read(file, os.fspath(path))


def loads(data: bytes) -> Buffer:
    """Return a new buffer with what ``dumps`` returned; see `load`."""
    import io

    return _read(io.BytesIO(data), "this")


def _read(stream: BinaryIO, name: str) -> Buffer:
    import json
    import zipfile

    try:
        with zipfile.ZipFile(stream) as file:
            _check_size(file)
            return _fill(json.loads(bytes(_array(file, "header", "|u1"))), file)
    except Exception as error:  # a damaged archive raises errors of many kinds
        raise ValueError(f"{name} is no saved buffer: {error}") from error


def _check_size(file: ZipFile) -> None:
    packed = sum(member.compress_size for member in file.infolist())
    unpacked = sum(member.file_size for member in file.infolist())
    if unpacked > _MOST_UNPACKED * packed + _ALWAYS_UNPACKED:
        raise ValueError(f"its {packed} bytes unpack to {unpacked}")


def _array(file: ZipFile, name: str, dtype: str) -> NDArray[Any]:
    """An array of the archive, whose size is that of its data and not what its header claims."""
    import io

    import numpy as np

    data = file.read(f"{name}.npy")
    stream = io.BytesIO(data)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError(f"{name} has an unknown format")
    shape, by_column, found = np.lib.format.read_array_header_1_0(stream)
    if by_column or found != np.dtype(dtype):
        raise ValueError(f"{name} is not a row-major array of {dtype}")
    return np.frombuffer(data, dtype, offset=stream.tell()).reshape(shape)


def _fill(header: Any, file: ZipFile) -> Buffer:
    from turtlewire.tf.buffer import Buffer

    if header["format"] != _FORMAT:
        raise ValueError(f"its format is {header['format']!r}, not {_FORMAT!r}")
    buffer = Buffer(header["cache_time_ns"])
    for i, (parent, child, static, sender) in enumerate(header["runs"]):
        stamps, poses = _array(file, f"stamps{i}", "<i8"), _array(file, f"poses{i}", "<f8")
        if static:
            x, y, z, qx, qy, qz, qw = poses[0].tolist()
            buffer.set_transform(parent, child, 0, (x, y, z), (qx, qy, qz, qw), True, sender)
        else:
            buffer.set_transforms(parent, child, stamps, poses, sender)
    return buffer
