"""Packets for a page: a JSON header and arrays that the browser uses without copying them.

A packet is a 32-bit little-endian length, its bytes of JSON (UTF-8, padded with spaces so that
the first array begins at a multiple of eight), and the arrays, each padded to a multiple of eight.
The header's ``arrays`` names them in order: ``{"poses": ["f4", [1000, 7]]}``.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any

_LENGTH = struct.Struct("<I")
_ALIGNMENT = 8
#: Formats of the buffer protocol.
_KINDS = {
    **dict.fromkeys("fd", "f"),
    **dict.fromkeys("bhilq", "i"),
    **dict.fromkeys("BHILQ", "u"),
}


def encode_packet(header: Mapping[str, Any], arrays: Mapping[str, Any] | None = None) -> bytes:
    """Return the bytes of one packet.

    Args:
        header: What JSON can hold; numbers must be finite.
        arrays: NumPy's or other buffers, of at most 64 bits an element; those that the page can
            only take as 32 bits or bytes are the caller's to convert.

    Raises:
        ValueError: The header holds a number that JSON cannot.
    """
    parts = {name: memoryview(array) for name, array in (arrays or {}).items()}
    shapes = {name: [_kind(part), part.shape] for name, part in parts.items()}
    text = json.dumps(
        {**header, "arrays": shapes}, ensure_ascii=False, separators=(",", ":"), allow_nan=False
    ).encode("utf-8", "replace")
    text += b" " * (-(_LENGTH.size + len(text)) % _ALIGNMENT)
    chunks = [_LENGTH.pack(len(text)), text]
    for part in parts.values():
        chunks += [part.tobytes(), bytes(-part.nbytes % _ALIGNMENT)]
    return b"".join(chunks)


def _kind(part: memoryview) -> str:
    return f"{_KINDS[part.format]}{part.itemsize}"
