"""The compiled half of this package, which may be missing or disabled."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import TYPE_CHECKING

from turtlewire.platforms import asked_core

from . import library as dds

if TYPE_CHECKING:
    from turtlewire._native import Cyclone
    from turtlewire.wire.base import Sink


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


#: Calls Cyclone from native code; None without it.
NATIVE = _load()


class Inlet:
    """Passes messages from Cyclone's thread to a sink: native code is the reader's listener.

    Attributes:
        sink: It is kept until the inlet is closed, because native code uses it.
        guard: The condition that is true while the sink needs service.
        listener: What to create the reader with.
    """

    def __init__(self, native: Cyclone, participant: int, sink: Sink) -> None:
        from turtlewire._native import CycloneInlet

        self.sink = sink
        self.guard = dds.check(dds.create_guard_condition(participant), "create a guard condition")
        self._native = CycloneInlet(native, self.guard, sink)
        callback, argument = self._native.listener()
        self.listener = dds.create_listener(argument)
        dds.lset_data_available(self.listener, callback)

    def rest(self, gid_of: Callable[[int], bytes]) -> list[tuple[bytes, int, int]]:
        """Serve the sink and return the messages that it left; call it until it returns none."""
        dds.set_guard_condition(self.guard, False)
        return self.sink.serve(gid_of)

    def call_again(self) -> None:
        """Trigger the guard: more may wait to be served."""
        dds.set_guard_condition(self.guard, True)

    def close(self) -> None:
        """End; to be called when the reader has been deleted and no thread is in native code."""
        dds.delete_listener(self.listener)
        dds.delete(self.guard)
