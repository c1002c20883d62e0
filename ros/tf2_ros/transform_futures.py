"""Futures that wait for transforms."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, NamedTuple

from rclpy.task import Future
from turtlewire.errors import InvalidArgumentException, TransformException

if TYPE_CHECKING:
    from collections.abc import Callable

    import turtlewire
    from geometry_msgs.msg import TransformStamped

__all__ = ["TransformFutures"]


class _Waiting(NamedTuple):
    future: Future
    can: Callable[[], bool]
    lookup: Callable[[], TransformStamped]


class TransformFutures:
    """Finishes futures when the data that they wait for has come. Thread-safe; costs nothing while nobody waits.

    Args:
        buffer: Where the data comes.
    """

    def __init__(self, buffer: turtlewire.Buffer) -> None:
        self._buffer = buffer
        self._lock = threading.Lock()
        self._waiting: list[_Waiting] = []
        self._stop_listening: Callable[[], None] | None = None

    def add(self, can: Callable[[], bool], lookup: Callable[[], TransformStamped]) -> Future:
        """A future for the result of ``lookup()``, which is called when ``can()`` has become true.

        A request that can never be answered, because a frame id is not valid, ends the future with the exception at once.
        """
        waiting = _Waiting(Future(), can, lookup)
        with self._lock:
            self._waiting.append(waiting)
            if self._stop_listening is None:
                self._stop_listening = self._buffer.add_change_listener(self._look_again)
        try:
            result = lookup()
        except InvalidArgumentException as error:
            if self._claim(waiting):
                waiting.future.set_exception(error)
        except TransformException:
            pass  # not yet: that is what the future is for
        else:
            if self._claim(waiting):
                waiting.future.set_result(result)
        return waiting.future

    def _look_again(self) -> None:
        """After data came in, on the thread that brought it."""
        with self._lock:
            candidates = list(self._waiting)
        for waiting in candidates:
            if waiting.future.cancelled():
                self._claim(waiting)
            elif waiting.can():
                self._finish(waiting)

    def _finish(self, waiting: _Waiting) -> None:
        try:
            result = waiting.lookup()
        except TransformException:
            return  # another thread has cleared the buffer, or pushed the time out of it
        if self._claim(waiting):
            waiting.future.set_result(result)

    def _claim(self, waiting: _Waiting) -> bool:
        """Whether this call took it off the list, so that of two threads one finishes it."""
        with self._lock:
            if waiting not in self._waiting:
                return False
            self._waiting.remove(waiting)
            if not self._waiting and self._stop_listening is not None:
                self._stop_listening()
                self._stop_listening = None
            return True
