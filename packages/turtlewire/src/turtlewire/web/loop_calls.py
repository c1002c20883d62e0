"""Calls from other threads to the thread of an asyncio loop."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from typing import Any


class LoopCalls:
    """Calls functions on the thread of the running loop, until it is closed."""

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._lock = threading.Lock()
        self._waiting: list[tuple[Callable[..., None], tuple[Any, ...]]] = []
        self._is_closed = False

    def soon(self, call: Callable[..., None], *arguments: Any) -> None:
        """Call a function soon; nothing after the end. For any thread, and returns at once."""
        with self._lock:  # the loop must not end in between
            if self._is_closed:
                return
            self._waiting.append((call, arguments))
            if len(self._waiting) == 1:  # waking the loop is slow: once for many receivers
                self._loop.call_soon_threadsafe(self._run)

    def close(self) -> None:
        """Stop all further calls."""
        with self._lock:
            self._is_closed = True
            self._waiting.clear()

    def _run(self) -> None:
        with self._lock:
            waiting, self._waiting = self._waiting, []
        for call, arguments in waiting:
            self._loop.call_soon(call, *arguments)
