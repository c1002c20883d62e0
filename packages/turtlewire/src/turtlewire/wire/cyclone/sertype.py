"""Cyclone's internal type of an entity, from which samples are created.

Cyclone 11 has a function for it. In 0.10 it is a pointer in the structure of the topic. The
offset depends on the build of the library; the right pointer leads to Cyclone's table of default
types.
"""

from __future__ import annotations

import ctypes
import os
import sys

from turtlewire.errors import WireError

from . import library as dds

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
