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
from turtlewire.tf.links import links

if TYPE_CHECKING:
    from typing import BinaryIO

    from numpy.typing import NDArray

    from turtlewire.tf.implementation import BaseBuffer

    AnyBuffer = TypeVar("AnyBuffer", bound=BaseBuffer)

__all__ = ["read", "write"]

_FORMAT = "turtlewire buffer 1"
#: Equal poses shrink to a thousandth, but stamps only to a third: no buffer reaches this ratio.
_MOST_UNPACKED = 200
_ALWAYS_UNPACKED = 1_000_000  # bytes; files with a few static transforms


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
    try:
        with zipfile.ZipFile(file) as archive:
            _check_size(archive)
            header = json.loads(bytes(_array(archive, "header", "|u1")))
            return _filled(buffer_type, header, archive)
    except Exception as error:  # a damaged archive raises errors of many kinds
        raise ValueError(f"{name} is not a saved buffer: {error}") from error


def _check_size(file: zipfile.ZipFile) -> None:
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
            buffer.set_transform(parent, child, 0, (x, y, z), (qx, qy, qz, qw), True, sender)
        else:
            buffer.set_transforms(parent, child, stamps, poses, sender)
    return buffer
