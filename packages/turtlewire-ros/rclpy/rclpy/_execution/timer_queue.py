"""The timers of an executor, ordered by the time at which they are due."""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["TimerQueue"]


T = TypeVar("T")


class TimerQueue(Generic[T]):
    """A heap of due times on the monotonic clock. Thread-safe.

    A rescheduled or removed timer leaves its old entry in the heap. Each entry has a ticket, and
    only a timer's newest ticket is valid. Old entries are removed before they outnumber the others.

    Args:
        on_earlier: Called, without locks held, when the next due time becomes earlier, so that the
            waiting thread can shorten its wait.
    """

    def __init__(self, on_earlier: Callable[[], None]) -> None:
        self._on_earlier = on_earlier
        self._heap: list[tuple[int, int, T]] = []
        self._tickets: dict[T, int] = {}
        self._next_ticket = itertools.count()
        self._lock = threading.Lock()

    def schedule(self, timer: T, delay_ns: int | None) -> None:
        """Make ``timer`` due after ``delay_ns``; None: not until it is scheduled again.

        Replaces its former entry.
        """
        with self._lock:
            if delay_ns is None:
                self._tickets.pop(timer, None)
                self._sweep()
                return
            ticket = self._tickets[timer] = next(self._next_ticket)
            # The ticket orders timers with equal times, because timers cannot be compared.
            entry = (time.monotonic_ns() + delay_ns, ticket, timer)
            heapq.heappush(self._heap, entry)
            self._sweep()
            is_first = self._heap[0] is entry
        if is_first:
            self._on_earlier()

    def discard(self, timer: T) -> None:
        """Forget ``timer``."""
        self.schedule(timer, None)

    def time_until_next(self) -> int | None:
        """Nanoseconds until the next timer is due, 0 if it is due, None without timers."""
        with self._lock:
            self._drop_stale()
            return max(0, self._heap[0][0] - time.monotonic_ns()) if self._heap else None

    def pop_due(self) -> list[T]:
        """Remove and return the timers that are due; each must be scheduled again to come back."""
        due: list[T] = []
        with self._lock:
            now = time.monotonic_ns()
            self._drop_stale()
            while self._heap and self._heap[0][0] <= now:
                timer = heapq.heappop(self._heap)[2]
                del self._tickets[timer]
                due.append(timer)
                self._drop_stale()
        return due

    def _sweep(self) -> None:
        if len(self._heap) > 2 * len(self._tickets):
            self._heap = [entry for entry in self._heap if self._tickets.get(entry[2]) == entry[1]]
            heapq.heapify(self._heap)

    def _drop_stale(self) -> None:
        while self._heap and self._tickets.get(self._heap[0][2]) != self._heap[0][1]:
            heapq.heappop(self._heap)
