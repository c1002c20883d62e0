"""Writes the samples and static transforms of a buffer to a file, and reads them again.

The format is NumPy's ``.npz``, without pickled objects.
"""

from __future__ import annotations

import io
import json
import zipfile
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from turtlewire.errors import LookupException
from turtlewire.path_arguments import BAGS, PICTURES, TRAJECTORIES, refuse_other_formats
from turtlewire.terminal.printable import printable
from turtlewire.tf.links import links

if TYPE_CHECKING:
    import os
    from typing import BinaryIO

    from numpy.typing import NDArray

    from turtlewire.tf.implementation import BaseBuffer

    AnyBuffer = TypeVar("AnyBuffer", bound=BaseBuffer)

__all__ = ["check_name", "read", "write"]

_FORMAT = "turtlewire buffer 1"
#: Equal poses shrink to a thousandth, but stamps only to a third: no buffer reaches this ratio.
_MOST_UNPACKED = 200
_ALWAYS_UNPACKED = 1_000_000  # bytes; files with a few static transforms
#: The first bytes of every ``.npz``.
_START = b"PK\3\4"
_FOREIGN = (
    "it has the arrays {}, and no header of Buffer.save; read it with numpy.load, and fill a "
    "buffer with set_transforms"
)
_INSTEAD = {
    TRAJECTORIES: "buffer.trajectory(target, source).save(path) writes the path of one frame",
    PICTURES: "buffer.trajectory(target, source).plot().save(path) draws the path of one frame",
    BAGS: "turtlewire.bag.BagWriter writes bags, whose transforms are messages of /tf",
    (".txt",): "print(buffer) shows the tree as text",
}


def check_name(path: str | os.PathLike[str]) -> None:
    """Raise ValueError for a name that ends in the suffix of another format."""
    refuse_other_formats(path, (".npz",), "a buffer is saved as .npz", _INSTEAD)


def write(buffer: BaseBuffer, file: BinaryIO) -> None:
    """Write all samples and static transforms of a buffer."""
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


def read(file: BinaryIO, name: str, buffer_type: type[AnyBuffer]) -> AnyBuffer:
    """Return a new buffer with what `write` wrote.

    Memory and time stay in proportion to the size of the file, whatever it contains.

    Raises:
        ValueError: The file is something else, or damaged; the text begins with ``name``.
    """
    start = file.read(4)
    if not start:
        raise ValueError(
            f"{name} is not a saved buffer, because it is empty; save the buffer again"
        )
    file.seek(0)
    try:
        with zipfile.ZipFile(file) as archive:
            _check_members(archive)
            header = json.loads(bytes(_array(archive, "header", "|u1")))
            return _filled(buffer_type, header, archive)
    except zipfile.BadZipFile as error:
        remedy = "to read a bag, call Buffer.from_bag"
        if start == _START:
            remedy = "it was cut off or damaged; save the buffer again"
        raise ValueError(f"{name} is not a saved buffer: {error}; {remedy}") from error
    except Exception as error:  # damaged archives raise many kinds of errors
        raise ValueError(f"{name} is not a saved buffer: {error}") from error


def _check_members(file: zipfile.ZipFile) -> None:
    """Raise ValueError for files of others, and for ones that unpack to too much."""
    names = [printable(name.removesuffix(".npy")) for name in file.namelist()[:5]]
    if "header.npy" not in file.namelist():
        raise ValueError(_FOREIGN.format(", ".join(names)))
    packed = sum(member.compress_size for member in file.infolist())
    unpacked = sum(member.file_size for member in file.infolist())
    if unpacked > _MOST_UNPACKED * packed + _ALWAYS_UNPACKED:
        raise ValueError(f"its {packed} bytes unpack to {unpacked}")


def _array(file: zipfile.ZipFile, name: str, dtype: str) -> NDArray[Any]:
    """An array of the archive, whose size is that of its data and not what its header claims."""
    data = file.read(f"{name}.npy")
    stream = io.BytesIO(data)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError(f"{name} has an unknown format")
    shape, by_column, found = np.lib.format.read_array_header_1_0(stream)
    if by_column or found != np.dtype(dtype):
        raise ValueError(f"{name} is not a row-major array of {dtype}")
    return np.frombuffer(data, dtype, offset=stream.tell()).reshape(shape)


def _filled(buffer_type: type[AnyBuffer], header: Any, file: zipfile.ZipFile) -> AnyBuffer:
    if header["format"] != _FORMAT:
        raise ValueError(f"its format is {header['format']!r}, not {_FORMAT!r}")
    buffer = buffer_type(header["cache_time_ns"])
    for i, (parent, child, static, sender) in enumerate(header["runs"]):
        stamps, poses = _array(file, f"stamps{i}", "<i8"), _array(file, f"poses{i}", "<f8")
        if static:
            x, y, z, qx, qy, qz, qw = poses[0].tolist()
            buffer.set_static_transform(parent, child, (x, y, z), (qx, qy, qz, qw), sender=sender)
        else:
            # tf2 drops old samples only when the next one comes, so a history may be a little
            # longer than the cache time.
            buffer.set_transforms(parent, child, stamps, poses, errors="skip", sender=sender)
    return buffer
