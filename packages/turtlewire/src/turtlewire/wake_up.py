"""Events that end a wait: of a thread, safe from signals, and of a task of asyncio."""

from __future__ import annotations

import threading
from contextlib import suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import asyncio


_LONGEST_NS = int(threading.TIMEOUT_MAX * 1_000_000_000)


def seconds_of(timeout_ns: int | None) -> float | None:
    """Convert a timeout to seconds; None (no limit) for more than a thread can wait."""
    if timeout_ns is None or timeout_ns >= _LONGEST_NS:
        return None
    return max(timeout_ns, 0) / 1e9


class WakeUp:
    """Ends a wait of another thread; each wait clears it.

    A signal raises ``KeyboardInterrupt`` in the main thread wherever that is. Within a method of
    `threading.Event` or `threading.Condition`, which are written in Python, the exception may leave
    their lock locked: the thread that calls ``set`` then blocks without end. The methods of a lock
    are written in C, where no exception comes in between.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._lock.acquire()

    def set(self) -> None:
        """End the current wait, or the next one at once."""
        with suppress(RuntimeError):  # already set
            self._lock.release()

    def wait(self, timeout: float | None = None) -> bool:
        """Block until it is set, and clear it.

        Args:
            timeout: Seconds; None for no limit.

        Returns:
            False after the timeout.
        """
        if timeout is None or timeout >= threading.TIMEOUT_MAX:
            return self._lock.acquire()
        return self._lock.acquire(timeout=max(timeout, 0.0))


class LoopWakeUp:
    """Ends the wait of a task of an asyncio loop; each wait clears it.

    One task waits at a time.

    Args:
        loop: The loop of the task.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._is_set = False
        self._waiter: asyncio.Future[None] | None = None

    def set(self) -> None:
        """End the current wait, or the next one at once. For any thread."""
        if self._is_set:
            return
        self._is_set = True
        with suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(self._finish)

    def _finish(self) -> None:
        if self._waiter is not None and not self._waiter.done():
            self._waiter.set_result(None)

    async def wait(self, timeout: float | None = None) -> None:
        """Wait until it is set, at most ``timeout`` seconds, and clear it."""
        if not self._is_set:
            self._waiter = self._loop.create_future()
            alarm = None if timeout is None else self._loop.call_later(timeout, self._finish)
            try:
                await self._waiter
            finally:
                self._waiter = None
                if alarm is not None:
                    alarm.cancel()
        self._is_set = False
