"""Counts calls into Zenoh's library, which must return before the interpreter ends."""

from __future__ import annotations

import threading

from turtlewire.errors import WireError

__all__ = ["Calls"]


class Calls:
    """Lets threads into the library until it is closed; a context manager. Thread-safe.

    At its end, Python ends a daemon thread that comes back from a library by unwinding its stack.
    Rust aborts the process then. So no thread may be in the library at that time, not even to
    free one of its objects.
    """

    def __init__(self) -> None:
        # The lock itself is taken by each call: the methods of a condition are in Python, and slow.
        self._lock = threading.RLock()
        self._changed = threading.Condition(self._lock)
        self._running: list[int] = []
        self._closed = False

    def __enter__(self) -> None:
        """Begin a call.

        Raises:
            WireError: The context is closed.
        """
        with self._lock:
            if self._closed:
                raise WireError("the context is closed")
            self._running.append(threading.get_ident())

    def __exit__(self, *_: object) -> None:
        """End a call."""
        with self._lock:
            self._running.remove(threading.get_ident())
            if self._closed:
                self._changed.notify_all()

    def close(self) -> None:
        """Reject further calls."""
        with self._lock:
            self._closed = True

    def join(self) -> None:
        """Wait for the end of the calls of all other threads; after closing.

        A signal handler may close what its own thread is about to use.
        """
        own = threading.get_ident()
        with self._changed:
            self._changed.wait_for(lambda: all(caller == own for caller in self._running))
