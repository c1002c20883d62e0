"""Messages out of a reader: by native code, or through ctypes where the compiled core is missing or not wanted."""

from __future__ import annotations

import ctypes
import os
from typing import TYPE_CHECKING

from . import library as dds

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["NATIVE_FUNCTIONS", "take_messages", "take_with_ctypes"]

_BATCH = 32


def _address(function: Callable[..., object]) -> int:
    address = ctypes.cast(function, ctypes.c_void_p).value  # type: ignore[arg-type] # a function of ctypes
    assert address is not None
    return address


#: Addresses of what native code calls of Cyclone.
NATIVE_FUNCTIONS = tuple(
    _address(function)
    for function in (
        dds.take_serdata,
        dds.serdata_size,
        dds.serdata_to_bytes,
        dds.serdata_unref,
        dds.set_guard_condition,
    )
)


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
                data = bytes(
                    dds.serdata_size(serdata[index])
                )  # new, and nobody else's yet: filled in place
                dds.serdata_to_bytes(serdata[index], 0, len(data), data)
                taken.append((data, infos[index].publication_handle, infos[index].source_timestamp))
            dds.serdata_unref(serdata[index])
        if count < wanted:
            break
        limit -= wanted
    return taken


def _choose() -> Callable[[int, int], list[tuple[bytes, int, int]]]:
    if os.environ.get("TURTLEWIRE_CORE") == "python":
        return take_with_ctypes
    try:
        from turtlewire._native import Taker
    except ModuleNotFoundError:
        return take_with_ctypes
    return Taker(NATIVE_FUNCTIONS).take


#: What does :func:`take_with_ctypes`, as fast as can be.
take_messages = _choose()
