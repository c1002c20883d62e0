"""The attachment of each message, request and response."""

from __future__ import annotations

from struct import Struct
from typing import NamedTuple

_GID_SIZE = 16
_LAYOUT = Struct(f"<qqB{_GID_SIZE}s")
#: rmw_zenoh_cpp 0.2.0 to 0.2.3 wrote the name of each value in front of it.
_NAMED_LAYOUT = Struct(f"<16xq17xq11xB{_GID_SIZE}s")


class Attachment(NamedTuple):
    """Origin of a message.

    Attributes:
        sequence_number: Counted by the publisher or client from 1.
        source_timestamp_ns: When it was written, system time.
        gid: 16 bytes, of the publisher; beside requests and their responses, of the client.
    """

    sequence_number: int
    source_timestamp_ns: int
    gid: bytes

    @classmethod
    def unpack(cls, data: bytes) -> Attachment:
        """Read either layout.

        Raises:
            ValueError: The bytes have neither layout.
        """
        for layout in (_LAYOUT, _NAMED_LAYOUT):
            if len(data) == layout.size:
                sequence_number, source_timestamp_ns, size, gid = layout.unpack(data)
                if size == _GID_SIZE:
                    return cls(sequence_number, source_timestamp_ns, gid)
        raise ValueError(f"an attachment of {len(data)} bytes is not one of rmw_zenoh_cpp")


def pack_attachment(sequence_number: int, source_timestamp_ns: int, gid: bytes) -> bytes:
    """Return the 33 bytes of an `Attachment`, as ROS 2 Jazzy (0.2.4) and later write them."""
    return _LAYOUT.pack(sequence_number, source_timestamp_ns, _GID_SIZE, gid)
