"""The compiled half of this package; None if it is missing or disabled."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import TYPE_CHECKING

from turtlewire.platforms import asked_core

from . import library as dds

if TYPE_CHECKING:
    from turtlewire._native import Cyclone


def address_of(function: Callable[..., object]) -> int:
    """Return the address of a function of ctypes."""
    address = ctypes.cast(function, ctypes.c_void_p).value  # type: ignore[arg-type]
    assert address is not None
    return address


def _load() -> Cyclone | None:
    if asked_core() == "python":
        return None
    try:
        from turtlewire._native import Cyclone
    except ModuleNotFoundError:
        return None
    functions = (
        dds.take_serdata,
        dds.serdata_size,
        dds.serdata_to_bytes,
        dds.serdata_unref,
        dds.set_guard_condition,
        dds.serdata_from_bytes,
        dds.write_serdata,
        dds.wait_set_wait,
    )
    info = dds.SampleInfo
    members = (info.valid_data, info.source_timestamp, info.publication_handle)
    layout = (ctypes.sizeof(info), *(member.offset for member in members))
    return Cyclone([address_of(function) for function in functions], layout)


#: Calls Cyclone from native code.
NATIVE = _load()
