"""Records which callback each thread is running."""

from __future__ import annotations

import threading

__all__ = ["RunningCallbacks"]


class RunningCallbacks:
    """Counts the callbacks that run, thread by thread: ``with running: callback()``.

    Thread-safe.
    """

    def __init__(self) -> None:
        self._counts: dict[int, int] = {}
        # `with` takes the lock itself, which a signal cannot leave locked; see turtlewire.wake_up.
        self._lock = threading.RLock()
        self._changed = threading.Condition(self._lock)

    def __enter__(self) -> None:
        self._count(1)

    def __exit__(self, *exception: object) -> None:
        self._count(-1)

    def _count(self, change: int) -> None:
        thread = threading.get_ident()
        with self._lock:
            count = self._counts.get(thread, 0) + change
            if count:
                self._counts[thread] = count
            else:
                del self._counts[thread]
                self._changed.notify_all()

    def of_this_thread(self) -> int:
        """Return the number of callbacks nested in this thread."""
        return self._counts.get(threading.get_ident(), 0)

    def wait_for_others(self, timeout_sec: float | None) -> bool:
        """Block until no other thread runs a callback; False if the timeout passes first."""
        me = threading.get_ident()
        with self._lock:
            return self._changed.wait_for(lambda: not self._counts.keys() - {me}, timeout_sec)
