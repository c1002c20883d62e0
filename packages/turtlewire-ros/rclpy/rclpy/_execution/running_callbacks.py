"""Records which callback each thread is running."""

from __future__ import annotations

import threading
import time

from turtlewire.wake_up import WakeUp


class RunningCallbacks:
    """Counts the callbacks that run, thread by thread: ``with running: callback()``.

    Thread-safe without a lock, because each thread changes only its own entry.
    """

    def __init__(self) -> None:
        self._counts: dict[int, int] = {}
        self._waits: set[WakeUp] = set()

    def __enter__(self) -> None:
        thread = threading.get_ident()
        self._counts[thread] = self._counts.get(thread, 0) + 1

    def __exit__(self, *exception: object) -> None:
        thread = threading.get_ident()
        count = self._counts[thread] - 1
        if count:
            self._counts[thread] = count
            return
        del self._counts[thread]
        # After the deletion: a wait that begins at this moment looks at the counts once more.
        if self._waits:
            for wait in list(self._waits):
                wait.set()

    def of_this_thread(self) -> int:
        """Return the number of callbacks nested in this thread."""
        return self._counts.get(threading.get_ident(), 0)

    def wait_for_others(self, timeout_sec: float | None) -> bool:
        """Block until no other thread runs a callback; False if the timeout passes first."""
        deadline = None if timeout_sec is None else time.monotonic() + timeout_sec
        me = {threading.get_ident()}
        change = WakeUp()
        self._waits.add(change)
        try:
            while set(self._counts) - me:
                remaining = None if deadline is None else deadline - time.monotonic()
                if remaining is not None and remaining <= 0:
                    return False
                change.wait(remaining)
            return True
        finally:
            self._waits.discard(change)
