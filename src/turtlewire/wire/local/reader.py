"""The reader thread of the in-process middleware."""

from __future__ import annotations

import threading
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
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""
        with self._condition:
            if self._closed:
                return
            self._work.append(work)
            self._condition.notify()
            if self._thread is None:
                self._thread = threading.Thread(
                    target=self._run, name="turtlewire-reader", daemon=True
                )
                self._thread.start()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._work or self._closed)
                if self._closed:
                    return
                work = self._work.popleft()
            work()

    def close(self) -> None:
        """End the thread and join it, unless this is it."""
        with self._condition:
            self._closed = True
            self._condition.notify()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()
