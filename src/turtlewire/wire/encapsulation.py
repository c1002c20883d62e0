"""The four bytes in front of every serialized message."""

from __future__ import annotations

from turtlewire.errors import WireError

__all__ = ["HEADER_SIZE", "LITTLE_ENDIAN", "require_message"]

HEADER_SIZE = 4

#: The first two bytes of little endian plain CDR, the only encoding that ROS 2 sends on common
#: machines.
LITTLE_ENDIAN = b"\x00\x01"


def require_message(cdr: bytes, topic: str) -> None:
    """Refuse bytes that cannot be a message, before they get onto the wire.

    Raises:
        WireError: There are no fields after the header, or the header is not that of little endian
            CDR.
    """
    if len(cdr) <= HEADER_SIZE or not cdr.startswith(LITTLE_ENDIAN):
        raise WireError(
            f"publish on {topic}: {len(cdr)} bytes with header '{cdr[:4].hex(' ')}' are no message (expected 00 01 00 00)"
        )
