"""The thread that calls callbacks, for middlewares without one in C; asyncio in a browser tab.

`deliver` hands messages to the callback of a subscription, whichever thread it is.
"""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Protocol

from turtlewire.guarded import call_guarded
from turtlewire.wake_up import WakeUp

if TYPE_CHECKING:
    from .base import MessageInfo


class Reader(Protocol):
    """Runs what is submitted, in order; if it raises, that is reported, and the next runs."""

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""

    def close(self) -> None:
        """Run nothing more."""


class ReaderThread:
    """Runs what is submitted, in order, on one thread that starts with the first submission."""

    def __init__(self) -> None:
        # Not a `threading.Condition`, which a signal can leave locked; see `turtlewire.wake_up`.
        self._lock = threading.RLock()
        self._changed = WakeUp()
        self._work: deque[Callable[[], None]] = deque()
        self._later: list[tuple[int, int, Callable[[], None]]] = []
        self._numbers = itertools.count()
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""
        with self._lock:
            if self._closed:
                return
            self._work.append(work)
            self._start()

    def submit_after(self, delay_ns: int, work: Callable[[], None]) -> None:
        """Run ``work`` when this time has passed."""
        with self._lock:
            if self._closed:
                return
            # The number orders work of one time; functions cannot be compared.
            when = time.monotonic_ns() + delay_ns
            heapq.heappush(self._later, (when, next(self._numbers), work))
            self._start()

    def _start(self) -> None:
        self._changed.set()
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="turtlewire-reader", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while True:
            with self._lock:
                if self._closed:
                    return
                delay = self._time_to_next()
                work = self._next_work() if self._work or delay == 0 else None
            if work is None:
                self._changed.wait(delay)
            else:
                call_guarded(work)

    def _next_work(self) -> Callable[[], None]:
        return self._work.popleft() if self._work else heapq.heappop(self._later)[2]

    def _time_to_next(self) -> float | None:
        if not self._later:
            return None
        return max(0, self._later[0][0] - time.monotonic_ns()) / 1e9

    def close(self) -> None:
        """End the thread and join it, unless this is it."""
        with self._lock:
            self._closed = True
            self._changed.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()


class LoopReader:
    """Runs what is submitted in asyncio's loop, where no thread can be started."""

    def __init__(self) -> None:
        self._closed = False

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""
        import asyncio

        if not self._closed:
            asyncio.get_event_loop().call_soon(self._run, work)

    def _run(self, work: Callable[[], None]) -> None:
        if not self._closed:
            call_guarded(work)

    def close(self) -> None:
        """Run nothing more."""
        self._closed = True


def deliver(
    messages: Iterable[tuple[bytes, MessageInfo]],
    on_message: Callable[[bytes, MessageInfo], None],
    is_closed: Callable[[], bool],
) -> None:
    """Call ``on_message`` for each message until the subscription is closed."""
    for message in messages:
        if is_closed():
            return
        call_guarded(on_message, *message)
