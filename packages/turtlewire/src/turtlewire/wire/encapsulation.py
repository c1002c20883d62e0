"""The four bytes in front of every serialized message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Union

from turtlewire.errors import WireError

if TYPE_CHECKING:
    from typing_extensions import Buffer

Cdr = Union[bytes, bytearray, "tuple[Buffer, ...]"]
"""A serialized message: its bytes, or the buffers that make it up one after the other."""

HEADER_SIZE = 4

#: The first two bytes of little endian plain CDR, the only encoding that ROS 2 sends on common
#: machines.
LITTLE_ENDIAN = b"\x00\x01"


def joined(cdr: Cdr) -> bytes:
    """Return the bytes of a serialized message."""
    return b"".join(cdr if isinstance(cdr, tuple) else (cdr,))


def is_message(cdr: bytes) -> bool:
    """Return True if these bytes are little endian CDR with fields after the header."""
    return len(cdr) > HEADER_SIZE and cdr.startswith(LITTLE_ENDIAN)


def no_message(cdr: bytes, topic: str) -> WireError:
    """The error for bytes that are not (see :func:`is_message`), before they get onto the wire."""
    return WireError(
        f"publish on {topic}: {len(cdr)} bytes with header '{cdr[:4].hex(' ')}' "
        "are not a message (expected 00 01 00 00)"
    )


def require_message(cdr: bytes, topic: str) -> None:
    """Reject bytes that are not a message.

    Raises:
        WireError: The bytes are not a message.
    """
    if not is_message(cdr):
        raise no_message(cdr, topic)
