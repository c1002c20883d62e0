"""Reads tf2_msgs/msg/TFMessage from its CDR bytes."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import TYPE_CHECKING

from turtlewire.errors import CdrError

if TYPE_CHECKING:
    from turtlewire.geometry.poses import Pose


def decode_tf_message(data: bytes) -> list[tuple[int, bytes, bytes, Pose]]:
    """Return the transforms of a message: (stamp in ns, parent, child, pose).

    Raises:
        CdrError: The bytes are not a TFMessage.
    """
    if len(data) < 8:
        raise CdrError(f"not a TFMessage: a TFMessage has at least 8 bytes, these are {len(data)}")
    if data[0] != 0 or data[1] > 1:
        raise CdrError(
            f"not a TFMessage: the first two bytes, {data[0]} {data[1]}, "
            "are not those of plain CDR (0 0 or 0 1)"
        )
    order = "<" if data[1] else ">"
    (count,) = struct.unpack_from(order + "I", data, 4)
    if count > len(data) // 72:
        raise CdrError(
            f"not a TFMessage: {count} transforms are announced, which do not fit into "
            f"{len(data)} bytes"
        )
    return list(_transforms(data, count, order))


def _transforms(data: bytes, count: int, order: str) -> Iterator[tuple[int, bytes, bytes, Pose]]:
    at = 8
    for i in range(count):
        try:
            at = _aligned(at, 4)
            sec, nanosec = struct.unpack_from(order + "iI", data, at)
            parent, at = _text(data, at + 8, order)
            child, at = _text(data, at, order)
            at = _aligned(at, 8)
            pose: Pose = struct.unpack_from(order + "7d", data, at)
        except (struct.error, IndexError) as error:
            raise CdrError(
                f"not a TFMessage: transform {i} of {count} ends beyond the {len(data)} bytes, "
                "or has a string without its final NUL"
            ) from error
        at += 56
        yield sec * 1_000_000_000 + nanosec, parent, child, pose


def _aligned(at: int, size: int) -> int:
    return 4 + (at - 4 + size - 1) // size * size  # counted from behind the 4-byte header


def _text(data: bytes, at: int, order: str) -> tuple[bytes, int]:
    at = _aligned(at, 4)
    (length,) = struct.unpack_from(order + "I", data, at)
    at += 4
    if length == 0:
        return b"", at
    if data[at + length - 1] != 0:  # an IndexError beyond the end
        raise IndexError
    return data[at : at + length - 1], at + length
