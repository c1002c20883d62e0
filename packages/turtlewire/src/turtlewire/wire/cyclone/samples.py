"""Samples of Cyclone: takes them from a reader and writes them to a writer.

Native code does both; where it was not built, ctypes does.

A sample is created from Cyclone's internal type of an entity. Cyclone 11 has a function that
returns it. In 0.10 it is a pointer in the structure of the topic. The offset depends on the build
of the library; the right pointer leads to Cyclone's table of default types.
"""

from __future__ import annotations

import ctypes
import os
import sys
import threading
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire.encapsulation import is_message, joined

from . import library as dds
from .native import NATIVE

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


#: Words of a ``dds_topic`` that are looked at; the pointer is word 68 of Debian's build.
_WORDS = 75
_WORD = ctypes.sizeof(ctypes.c_void_p)


def sertype_of(entity: int) -> int:
    """The address of the ``ddsi_sertype`` of a topic or a writer; it lives as long as the topic.

    Raises:
        WireError: The entity does not exist, or this build of Cyclone has another layout of topics.
    """
    if dds.ABI.tells_type:
        sertype = ctypes.c_void_p()
        dds.check(dds.get_sertype(entity, sertype), "read the type of a writer")
        return sertype.value or 0
    topic = dds.get_topic(entity)
    return _of_topic(topic if topic > 0 else entity)


class _Place:
    """The offset of the pointer in a ``dds_topic``, the same for all topics of a library."""

    word: int | None = None


def _of_topic(topic: int) -> int:
    structure = ctypes.c_void_p()
    dds.check(dds.pin_entity(topic, structure), "read the type of a topic")
    try:
        assert structure.value is not None
        words: list[int] = list((ctypes.c_size_t * _WORDS).from_address(structure.value))
    finally:
        dds.unpin_entity(structure)
    if _Place.word is None:
        _Place.word = _find_default_type(words)
    return words[_Place.word]


def _find_default_type(words: list[int]) -> int:
    """Return the index of the word that is a default type's address."""
    table = ctypes.addressof(dds.default_types).to_bytes(_WORD, sys.byteorder)
    reading, writing = os.pipe()
    try:
        for place, word in enumerate(words):
            # A word may be no address. The kernel refuses to read there; this process would crash.
            if _write_memory(writing, word) and os.read(reading, _WORD) == table:
                return place
    finally:
        os.close(reading)
        os.close(writing)
    raise WireError(f"{dds.LIBRARY} has an unexpected layout of topics")


def _write_memory(file: int, address: int) -> bool:
    """Write the word at an address to a file; False if there is no memory."""
    write = ctypes.CDLL(None).write
    return bool(write(file, ctypes.c_void_p(address), ctypes.c_size_t(_WORD)) == _WORD)


_BATCH = 32


def take_with_ctypes(reader: int, limit: int) -> list[tuple[bytes, int, int]]:
    """Take up to ``limit`` messages of a reader.

    Returns:
        Of each, its bytes, Cyclone's number of the publisher, and the time of sending in
        nanoseconds; none when the reader has gone.
    """
    taken = []
    serdata = (ctypes.c_void_p * _BATCH)()
    infos = (dds.SampleInfo * _BATCH)()
    while limit > 0:
        wanted = min(limit, _BATCH)
        count = dds.take_serdata(reader, serdata, wanted, infos, dds.ANY_STATE)
        for index in range(count):
            if infos[index].valid_data:
                # These bytes are new and not shared yet, so they may be filled in place.
                data = bytes(dds.serdata_size(serdata[index]))
                dds.serdata_to_bytes(serdata[index], 0, len(data), data)
                taken.append((data, infos[index].publication_handle, infos[index].source_timestamp))
            dds.serdata_unref(serdata[index])
        if count < wanted:
            break
        limit -= wanted
    return taken


#: What does :func:`take_with_ctypes`, as fast as can be.
take_messages = take_with_ctypes if NATIVE is None else NATIVE.take


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
