"""The timers of an executor, ordered by the time at which they are due."""

from __future__ import annotations

import heapq
import itertools
import math
import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class TimerQueue(Generic[T]):
    """A heap of due times on the monotonic clock. Thread-safe.

    A rescheduled or removed timer leaves its old entry in the heap. Each entry has a ticket, and
    only a timer's newest ticket is valid. Old entries are removed before they outnumber the others.

    Args:
        on_earlier: Called, without locks held, when a timer becomes due before a thread's wait ends
            (see :meth:`time_until_next`), so that the thread can shorten it.
    """

    def __init__(self, on_earlier: Callable[[], None]) -> None:
        self._on_earlier = on_earlier
        self._heap: list[tuple[int, int, T]] = []
        self._tickets: dict[T, int] = {}
        self._next_ticket = itertools.count()
        self._awaited_ns: float | None = None  # None: no thread waits
        self._lock = threading.Lock()

    def schedule(self, timer: T, delay_ns: int | None) -> None:
        """Make ``timer`` due after ``delay_ns``; None: not until it is scheduled again.

        Replaces its former entry.
        """
        with self._lock:
            if delay_ns is None:
                self._tickets.pop(timer, None)
                if len(self._heap) > 2 * len(self._tickets):
                    self._sweep()
                return
            ticket = self._tickets[timer] = next(self._next_ticket)
            # The ticket orders timers with equal times, because timers cannot be compared.
            entry = (time.monotonic_ns() + delay_ns, ticket, timer)
            heapq.heappush(self._heap, entry)
            if len(self._heap) > 2 * len(self._tickets):
                self._sweep()
            is_earlier = self._awaited_ns is not None and entry[0] < self._awaited_ns
        # A callback's own timer needs no wake-up: its thread starts the next wait by itself.
        if is_earlier:
            self._on_earlier()

    def discard(self, timer: T) -> None:
        """Forget ``timer``."""
        self.schedule(timer, None)

    def time_until_next(self) -> int | None:
        """Return the nanoseconds for which a thread may wait; call :meth:`pop_due` afterwards.

        0 if a timer is due, None without timers.
        """
        with self._lock:
            if len(self._heap) > len(self._tickets):
                self._drop_stale()
            if not self._heap:
                self._awaited_ns = math.inf
                return None
            self._awaited_ns = self._heap[0][0]
            return max(0, self._heap[0][0] - time.monotonic_ns())

    def pop_due(self) -> list[T]:
        """End the wait, and remove and return the timers that are due.

        Each must be scheduled again to come back.
        """
        due: list[T] = []
        with self._lock:
            self._awaited_ns = None
            now = time.monotonic_ns()
            while self._heap and self._heap[0][0] <= now:
                _, ticket, timer = heapq.heappop(self._heap)
                if self._tickets.get(timer) == ticket:
                    del self._tickets[timer]
                    due.append(timer)
        return due

    def _sweep(self) -> None:
        self._heap = [entry for entry in self._heap if self._tickets.get(entry[2]) == entry[1]]
        heapq.heapify(self._heap)

    def _drop_stale(self) -> None:
        while len(self._heap) > len(self._tickets):
            first = self._heap[0]
            if self._tickets.get(first[2]) == first[1]:
                return
            heapq.heappop(self._heap)
