"""The threads on which Zenoh's callbacks run."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, TypeVar

from zenoh.handlers import Callback as Handler

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CallbackThreads"]

_T = TypeVar("_T")


class CallbackThreads:
    """Starts, counts and joins the threads of a session's callbacks. Thread-safe.

    On a thread of Zenoh, callbacks would stop the whole link while another thread computes. They
    would also block ``AdvancedPublisher.undeclare()`` for 10 s: it holds the GIL while it waits for
    a task that needs such a thread.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._running = 0
        self._ended: list[threading.Thread] = []

    def declare(self, call: Callable[[Any], None], declare: Callable[[Any], _T]) -> _T:
        """Declare something whose callbacks run on a separate thread, which the library starts.

        Args:
            call: The callback.
            declare: Makes the declaration with the handler that it is given.
        """
        self.count_start()
        handler = Handler(call, self.count_end, indirect=True)
        return _on_a_daemon_thread(lambda: declare(handler))

    def count_start(self) -> None:
        """Count a thread that is about to start."""
        with self._changed:
            self._running += 1

    def count_end(self) -> None:
        """Note that the calling thread has nothing more to do."""
        with self._changed:
            self._running -= 1
            self._ended = [thread for thread in self._ended if thread.is_alive()]
            self._ended.append(threading.current_thread())
            self._changed.notify_all()

    def join(self) -> None:
        """Wait until all have ended; after closing the session."""
        with self._changed:
            self._changed.wait_for(lambda: not self._running)
            ended = self._ended
        for thread in ended:
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
