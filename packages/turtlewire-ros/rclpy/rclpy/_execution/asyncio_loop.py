"""Finds asyncio's running loop of this thread without importing asyncio."""

from __future__ import annotations

import sys
import weakref
from types import FrameType
from typing import Any

#: The loops that serve, or have served, asynchronous nodes.
loops_of_nodes: weakref.WeakSet[Any] = weakref.WeakSet()


def running_loop() -> Any:
    """Return the asyncio loop that runs in this thread, if any; never imports asyncio."""
    # While another thread imports asyncio, this one runs no loop and the module is not complete.
    get_running_loop = getattr(sys.modules.get("asyncio"), "_get_running_loop", None)
    return None if get_running_loop is None else get_running_loop()


def interrupted_loop(frame: FrameType | None) -> Any:
    """Return the running loop if it should end by itself after Ctrl-C.

    That is so in asyncio's own code, and everywhere if the loop serves asynchronous nodes: as
    after ``asyncio.run`` alone, their callbacks are cancelled.
    """
    loop = running_loop()
    module = "" if frame is None else str(frame.f_globals.get("__name__", ""))
    return loop if module.partition(".")[0] == "asyncio" or loop in loops_of_nodes else None
