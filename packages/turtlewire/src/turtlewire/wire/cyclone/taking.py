"""Takes messages from a reader, by native code or through ctypes."""

from __future__ import annotations

import ctypes

from . import library as dds
from .native import NATIVE

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
