"""The threads on which Zenoh's callbacks run, and the count of calls into its library."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, TypeVar

from zenoh.handlers import Callback as Handler

from turtlewire.errors import WireError

_T = TypeVar("_T")


class CallbackThreads:
    """Starts, counts and joins the threads of a session's callbacks. Thread-safe.

    On a thread of Zenoh, callbacks would stop the whole link while another thread computes. They
    would also block ``AdvancedPublisher.undeclare()`` for 10 s: it holds the GIL while it waits for
    a task that needs such a thread.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._running: set[object] = set()
        self._to_join: list[threading.Thread] = []

    def declare(self, call: Callable[[Any], None], declare: Callable[[Any], _T]) -> _T:
        """Declare something whose callbacks run on a separate thread, which the library starts.

        Args:
            call: The callback.
            declare: Makes the declaration with the handler that it is given.
        """
        running = object()
        with self._changed:
            self._running.add(running)
        handler = Handler(call, lambda: self._end(running), indirect=True)
        try:
            return _on_a_daemon_thread(lambda: declare(handler))
        except BaseException:
            # The library may have refused before it started the thread, which then never ends.
            self._remove(running)
            raise

    def start(self, run: Callable[[], None], name: str) -> None:
        """Start another thread, which ends by itself when the session is closed."""
        thread = threading.Thread(target=run, name=name, daemon=True)
        thread.start()
        self._join_later(thread)

    def _end(self, running: object) -> None:
        """Note that the calling thread is about to end."""
        self._join_later(threading.current_thread())
        self._remove(running)

    def _join_later(self, thread: threading.Thread) -> None:
        with self._changed:
            self._to_join = [*(other for other in self._to_join if other.is_alive()), thread]

    def _remove(self, running: object) -> None:
        with self._changed:
            self._running.discard(running)
            self._changed.notify_all()

    def join(self) -> None:
        """Wait until all have ended; after closing the session."""
        with self._changed:
            self._changed.wait_for(lambda: not self._running)
            threads = self._to_join
        for thread in threads:
            thread.join()


def _on_a_daemon_thread(call: Callable[[], _T]) -> _T:
    """Run ``call`` on a daemon thread.

    The library's thread for callbacks becomes a daemon if the thread that declares is one. A
    program that forgets to close would never end otherwise: Python waits for all other threads
    before it runs what was registered for the exit.
    """
    results: list[_T] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            results.append(call())
        except BaseException as error:  # noqa: BLE001 - raised again by the caller's thread
            errors.append(error)

    thread = threading.Thread(target=run, name="turtlewire-declare", daemon=True)
    thread.start()
    thread.join()
    if errors:
        raise errors[0]
    return results[0]


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
