"""Packets for the page: a JSON header and arrays that the browser uses without copying them.

A packet is a 32-bit little-endian length, its bytes of JSON (UTF-8, padded with spaces so that
the first array begins at a multiple of eight), and the arrays, each padded to a multiple of eight.
The header's ``arrays`` names them in order: ``{"poses": ["f4", [1000, 7]]}``.
"""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

__all__ = ["encode_packet"]

_LENGTH = struct.Struct("<I")
_ALIGNMENT = 8


def encode_packet(
    header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]] | None = None
) -> bytes:
    """Return the bytes of one packet.

    Args:
        header: What JSON can hold; numbers must be finite.
        arrays: Arrays of at most 64 bits an element; those that the page can only take as 32 bits
            or bytes are the caller's to convert.

    Raises:
        ValueError: The header holds a number that JSON cannot.
    """
    parts = [
        array if array.flags.c_contiguous else array.copy() for array in (arrays or {}).values()
    ]
    shapes = {
        name: [array.dtype.str.lstrip("<|=>"), list(array.shape)]
        for name, array in zip(arrays or {}, parts, strict=True)
    }
    text = json.dumps(
        {**header, "arrays": shapes}, ensure_ascii=False, separators=(",", ":"), allow_nan=False
    ).encode("utf-8", "replace")
    text += b" " * (-(_LENGTH.size + len(text)) % _ALIGNMENT)
    chunks = [_LENGTH.pack(len(text)), text]
    for array in parts:
        chunks += [array.tobytes(), bytes(-array.nbytes % _ALIGNMENT)]
    return b"".join(chunks)
