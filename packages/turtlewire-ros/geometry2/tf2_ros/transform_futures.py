"""Futures that wait for transforms."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.task import Future
from turtlewire.errors import TransformException

from .deadlines import Deadlines

if TYPE_CHECKING:
    from typing import Protocol

    import turtlewire
    from geometry_msgs.msg import TransformStamped

    class PendingLookup(Protocol):
        """A lookup in a buffer."""

        def never(self, error: TransformException) -> bool:
            """Return True if no later data can bring the answer, judged by the present error."""
            ...

        def answer(self) -> TransformStamped:
            """Return the transform; raises :class:`TransformException` until it is available."""
            ...


_deadlines = Deadlines()


class _Waiting:
    __slots__ = ("cancel_deadline", "future", "question")

    def __init__(self, question: PendingLookup) -> None:
        self.question = question
        self.future = Future()
        self.cancel_deadline: Callable[[], None] | None = None


class TransformFutures:
    """Completes futures when the buffer has the data. Thread-safe.

    It listens to the buffer only while a future is pending.

    Args:
        buffer: The buffer that receives the data.
    """

    def __init__(self, buffer: turtlewire.Buffer) -> None:
        self._buffer = buffer
        self._lock = threading.Lock()
        self._waiting: list[_Waiting] = []
        self._stop_listening: Callable[[], None] | None = None

    def add(self, question: PendingLookup, timeout_ns: int | None = None) -> Future:
        """Return a future for the answer.

        It gets the exception of the lookup after the timeout, and at once if there can be no
        answer: a frame id is invalid, or the requested time has left the cache.

        Args:
            question: The lookup.
            timeout_ns: How long to wait; None sets no limit.
        """
        waiting = _Waiting(question)
        with self._lock:
            self._waiting.append(waiting)
            if self._stop_listening is None:
                self._stop_listening = self._buffer.on_change(self._look_again)
        # After listening has begun, so that no data is missed.
        try:
            result = question.answer()
        except TransformException as error:
            if timeout_ns == 0 or question.never(error):
                self._finish(waiting, error)
        else:
            self._finish(waiting, result)
        if timeout_ns is not None and not waiting.future.done():
            waiting.cancel_deadline = _deadlines.call_after(
                timeout_ns / 1e9, lambda: self._give_up(waiting)
            )
        # A future that the user cancels also leaves the list.
        waiting.future.add_done_callback(lambda _future: self._claim(waiting))
        return waiting.future

    def _look_again(self) -> None:
        """Try all pending lookups again; runs on the thread that received data."""
        with self._lock:
            candidates = list(self._waiting)
        for waiting in candidates:
            self._look_at(waiting)

    def _look_at(self, waiting: _Waiting) -> None:
        try:
            self._finish(waiting, waiting.question.answer())
        except TransformException as error:
            if waiting.question.never(error):
                self._finish(waiting, error)

    def _give_up(self, waiting: _Waiting) -> None:
        # Asked once more, for the error that is true now.
        try:
            self._finish(waiting, waiting.question.answer())
        except TransformException as error:
            self._finish(waiting, error)

    def _finish(self, waiting: _Waiting, outcome: TransformStamped | TransformException) -> None:
        if not self._claim(waiting):
            return
        if isinstance(outcome, TransformException):
            waiting.future.set_exception(outcome)
        else:
            waiting.future.set_result(outcome)

    def _claim(self, waiting: _Waiting) -> bool:
        """Take it off the list, so that only one thread, or a cancellation, completes it."""
        with self._lock:
            if waiting not in self._waiting:
                return False
            self._waiting.remove(waiting)
            if not self._waiting and self._stop_listening is not None:
                self._stop_listening()
                self._stop_listening = None
        if waiting.cancel_deadline is not None:
            waiting.cancel_deadline()
        return True
