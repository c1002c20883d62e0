"""Writes messages to a writer, by native code or through ctypes."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from turtlewire.wire.encapsulation import is_message, joined

from . import library as dds
from .native import NATIVE
from .sertype import sertype_of

if TYPE_CHECKING:
    from typing import Protocol

    from turtlewire.wire.encapsulation import Cdr

    class Writer(Protocol):
        """Sends messages with one DDS writer. Thread-safe."""

        def write(self, cdr: Cdr) -> int:
            """Send a message.

            A negative code if that failed: one of Cyclone's or of this module.
            """
            ...

        def close(self) -> None:
            """Close the native writer; call this before the DDS writer and its type are deleted."""
            ...


# The codes that native/cyclone/writer.hpp adds to Cyclone's.
NO_MESSAGE, CLOSED, REFUSED, NO_IDENTITY = -1001, -1002, -1003, -1004


class CtypesWriter:
    """A ``Writer`` without native code."""

    def __init__(self, handle: int, sertype: int) -> None:
        self._handle = handle
        self._sertype = sertype
        self._lock = threading.Lock()
        self._closed = False

    def write(self, cdr: Cdr) -> int:
        """Write a message; return 0 or an error code."""
        cdr = joined(cdr)
        if not is_message(cdr):
            return NO_MESSAGE
        if len(cdr) & 3:  # Cyclone sends multiples of four bytes
            cdr += b"\x00" * (-len(cdr) & 3)
        size = len(cdr)
        with self._lock:
            if self._closed:
                return CLOSED
            serdata = dds.serdata_from_bytes(
                self._sertype, dds.SERDATA_KIND_DATA, 1, dds.IoVec(base=cdr, size=size), size
            )
        return int(dds.write_serdata(self._handle, serdata)) if serdata else REFUSED

    def close(self) -> None:
        """Refuse later writes."""
        with self._lock:
            self._closed = True


def make_writer(handle: int) -> Writer:
    """Return a sender of messages on a DDS writer.

    Raises:
        WireError: The writer has no type.
    """
    address = sertype_of(handle)
    if NATIVE is None:
        return CtypesWriter(handle, address)
    from turtlewire._native import CycloneWriter

    return CycloneWriter(NATIVE, handle, address)
