"""An event for the main thread that a signal cannot leave locked."""

from __future__ import annotations

import threading
from contextlib import suppress

__all__ = ["WakeUp"]


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
        return self._lock.acquire(timeout=-1 if timeout is None else max(timeout, 0.0))
