"""Calls functions later, on one thread that runs only while a call is due."""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections.abc import Callable

from turtlewire.guarded import call_guarded


class Deadlines:
    """Functions to call later. Thread-safe."""

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._numbers = itertools.count()
        self._due: list[tuple[float, int]] = []
        self._calls: dict[int, Callable[[], None]] = {}
        self._running = False

    def call_after(self, seconds: float, call: Callable[[], None]) -> Callable[[], None]:
        """Call ``call()`` after some seconds, unless the returned function is called before.

        If it raises, the exception is reported, and later calls still run.
        """
        with self._condition:
            number = next(self._numbers)
            self._calls[number] = call
            heapq.heappush(self._due, (time.monotonic() + seconds, number))
            self._condition.notify()
            if not self._running:
                self._running = True
                threading.Thread(target=self._run, name="tf2-deadlines", daemon=True).start()

        def cancel() -> None:
            with self._condition:
                self._calls.pop(number, None)
                self._condition.notify()

        return cancel

    def _run(self) -> None:
        while (call := self._next()) is not None:
            call_guarded(call)

    def _next(self) -> Callable[[], None] | None:
        """Block until a call is due; None if no call is left."""
        with self._condition:
            while self._calls:
                when, number = self._due[0]
                remaining = when - time.monotonic()
                # A cancelled call stays in the heap until it is at the front.
                if number not in self._calls:
                    heapq.heappop(self._due)
                elif remaining > 0:
                    self._condition.wait(remaining)
                else:
                    heapq.heappop(self._due)
                    return self._calls.pop(number)
            # Under the lock, so that `call_after` either sees the thread wait or starts a new one.
            self._due.clear()
            self._running = False
            return None
