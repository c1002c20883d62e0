"""Calls of other threads on the thread of an asyncio loop."""

from __future__ import annotations

import asyncio
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LoopCalls"]


class LoopCalls:
    """Calls functions on the thread of the running loop, until it is closed."""

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._lock = threading.Lock()
        self._is_closed = False

    def soon(self, call: Callable[..., None], *arguments: Any) -> None:
        """Call a function soon; nothing after the end. For any thread, and returns at once."""
        with self._lock:  # the loop must not end in between
            if not self._is_closed:
                self._loop.call_soon_threadsafe(call, *arguments)

    def close(self) -> None:
        """Call nothing any more."""
        with self._lock:
            self._is_closed = True
