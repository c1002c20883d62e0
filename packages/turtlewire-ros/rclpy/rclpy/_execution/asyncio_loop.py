"""Whether asyncio runs a loop in this thread; without importing asyncio."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import FrameType

__all__ = ["interrupted_loop", "running_loop"]


def running_loop() -> Any:
    """Return the asyncio loop that runs in this thread, if any; never imports asyncio."""
    # While another thread imports asyncio, this one runs no loop and the module is not complete.
    get_running_loop = getattr(sys.modules.get("asyncio"), "_get_running_loop", None)
    return None if get_running_loop is None else get_running_loop()


def interrupted_loop(frame: FrameType | None) -> Any:
    """The running loop, if a signal came in asyncio's own code: no coroutine, no callback."""
    module = "" if frame is None else str(frame.f_globals.get("__name__", ""))
    return running_loop() if module.partition(".")[0] == "asyncio" else None
