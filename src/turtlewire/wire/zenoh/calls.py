"""Calls into Zenoh's library, which must have returned before the interpreter ends."""

from __future__ import annotations

import threading

from turtlewire.errors import WireError

__all__ = ["Calls"]


class Calls:
    """Lets threads into the library until it is closed; a context manager. Thread-safe.

    At its end, Python ends a daemon thread that comes back from a library by unwinding its stack.
    Rust aborts the process then. So no thread may be in the library at that time.
    """

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._running = 0
        self._closed = False

    def __enter__(self) -> None:
        """Begin a call.

        Raises:
            WireError: It is closed.
        """
        with self._condition:
            if self._closed:
                raise WireError("the context is closed")
            self._running += 1

    def __exit__(self, *_: object) -> None:
        """End a call."""
        with self._condition:
            self._running -= 1
            if self._closed:
                self._condition.notify_all()

    def close(self) -> None:
        """Let nobody in any more."""
        with self._condition:
            self._closed = True

    def join(self) -> None:
        """Wait for the end of all calls; after closing."""
        with self._condition:
            self._condition.wait_for(lambda: not self._running)
