"""The thread that calls callbacks, for middlewares without one in C."""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Reader", "ReaderThread"]


class Reader(Protocol):
    """Runs what is submitted, in order."""

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""

    def close(self) -> None:
        """Run nothing more."""


class ReaderThread:
    """Runs what is submitted, in order, on one thread that starts with the first submission."""

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._work: deque[Callable[[], None]] = deque()
        self._later: list[tuple[int, int, Callable[[], None]]] = []
        self._numbers = itertools.count()
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""
        with self._condition:
            if self._closed:
                return
            self._work.append(work)
            self._start()

    def submit_after(self, delay_ns: int, work: Callable[[], None]) -> None:
        """Run ``work`` when this time has passed."""
        with self._condition:
            if self._closed:
                return
            # The number orders work of one time; functions cannot be compared.
            when = time.monotonic_ns() + delay_ns
            heapq.heappush(self._later, (when, next(self._numbers), work))
            self._start()

    def _start(self) -> None:
        self._condition.notify()
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="turtlewire-reader", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while True:
            with self._condition:
                while not self._closed and not self._is_due():
                    self._condition.wait(self._time_to_next())
                if self._closed:
                    return
                work = self._work.popleft() if self._work else heapq.heappop(self._later)[2]
            work()

    def _is_due(self) -> bool:
        return bool(self._work) or self._time_to_next() == 0

    def _time_to_next(self) -> float | None:
        if not self._later:
            return None
        return max(0, self._later[0][0] - time.monotonic_ns()) / 1e9

    def close(self) -> None:
        """End the thread and join it, unless this is it."""
        with self._condition:
            self._closed = True
            self._condition.notify()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()
