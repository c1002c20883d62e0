"""Images and point clouds as arrays that share the memory of their messages."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["cloud_array", "cloud_dtype", "image_array", "read_point_fields"]

_ENCODINGS = {
    "rgb8": ("u1", 3),
    "bgr8": ("u1", 3),
    "rgba8": ("u1", 4),
    "bgra8": ("u1", 4),
    "rgb16": ("u2", 3),
    "bgr16": ("u2", 3),
    "rgba16": ("u2", 4),
    "bgra16": ("u2", 4),
    "mono8": ("u1", 1),
    "mono16": ("u2", 1),
    "yuv422": ("u1", 2),
    "uyvy": ("u1", 2),
    "yuyv": ("u1", 2),
    "yuv422_yuy2": ("u1", 2),
}
_NUMBERED = re.compile(r"(8|16|32|64)([USF])C(\d*)")  # in the manner of OpenCV
_BAYER = re.compile(r"bayer_\w{4}(8|16)")

#: The datatypes of PointField, from 1.
_POINT_TYPES = ("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8")


def image_array(
    data: NDArray[np.uint8], height: int, width: int, step: int, encoding: str, order: str
) -> NDArray[Any]:
    """Return the pixels of an image, which share the memory of its bytes.

    Args:
        data: Its bytes.
        height: Its rows.
        width: Its columns.
        step: The bytes of a row.
        encoding: Its encoding, such as ``rgb8`` or ``32FC1``.
        order: The byte order of its numbers, ``"<"`` or ``">"``.

    Returns:
        Shape ``(height, width)`` or ``(height, width, channels)``; the bytes as they are if the
        encoding is unknown or does not fit them.
    """
    code, channels = _format(encoding)
    if not code:
        return data
    dtype = np.dtype(order + code)
    pixel = channels * dtype.itemsize
    if not height or not width or step < width * pixel or len(data) < step * height:
        return data
    shape = (height, width, channels)
    pixels: NDArray[Any] = np.ndarray(shape, dtype, data, strides=(step, pixel, dtype.itemsize))
    return pixels[:, :, 0] if channels == 1 else pixels


def _format(encoding: str) -> tuple[str, int]:
    """Return the letters of an encoding's numbers and its channels; no letters if it is unknown."""
    if found := _NUMBERED.fullmatch(encoding):
        bits, kind, channels = found.groups()
        code = {"U": "u", "S": "i", "F": "f"}[kind] + str(int(bits) // 8)
        return (code if code != "f1" else "", int(channels or 1))
    if found := _BAYER.fullmatch(encoding):
        return f"u{int(found[1]) // 8}", 1
    return _ENCODINGS.get(encoding, ("", 0))


def read_point_fields(data: bytes) -> list[tuple[str, int, int, int]]:
    """Return name, offset, datatype and count of the PointFields in little endian CDR."""
    fields, at = [], 0

    def number() -> int:
        nonlocal at
        at = -(-at // 4) * 4 + 4
        return int.from_bytes(data[at - 4 : at], "little")

    while at < len(data):
        size = number()
        name = data[at : at + max(0, size - 1)].decode("utf-8", "replace")
        at += size
        offset, datatype = number(), data[at]
        at += 1
        fields.append((name, offset, datatype, number()))
    return fields


def cloud_dtype(
    fields: Iterable[tuple[str, int, int, int]], point_step: int, order: str
) -> np.dtype[Any] | None:
    """Return the dtype of a point; None if the fields do not fit into one.

    Args:
        fields: Name, offset, datatype and count of each field.
        point_step: The bytes of a point.
        order: The byte order of its numbers, ``"<"`` or ``">"``.
    """
    names, formats, offsets = [], [], []
    for name, offset, datatype, count in fields:
        if not 1 <= datatype <= len(_POINT_TYPES) or not name or name in names:
            return None
        if count > point_step:
            return None
        code = order + _POINT_TYPES[datatype - 1]
        names.append(name)
        formats.append(code if count <= 1 else (code, (count,)))
        offsets.append(offset)
    layout = {"names": names, "formats": formats, "offsets": offsets, "itemsize": point_step}
    try:
        return np.dtype(layout) if names else None  # type: ignore[call-overload]
    except ValueError:  # a field lies behind the end of the point
        return None


def cloud_array(
    data: NDArray[np.uint8], height: int, width: int, row_step: int, dtype: np.dtype[Any] | None
) -> NDArray[Any]:
    """Return the points of a cloud, which share the memory of its bytes.

    Returns:
        A structured array of shape ``(width,)``, or ``(height, width)`` of an organized cloud; the
        bytes as they are if the dtype does not fit them.
    """
    if dtype is None or not height or not width:
        return data
    step = dtype.itemsize
    row = row_step if height > 1 else width * step
    if row < width * step or len(data) < row * (height - 1) + width * step:
        return data
    points: NDArray[Any] = np.ndarray((height, width), dtype, data, strides=(row, step))
    return points[0] if height == 1 else points
