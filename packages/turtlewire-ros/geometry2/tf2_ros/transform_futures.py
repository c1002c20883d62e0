"""Futures that wait for transforms, and their timeouts."""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from rclpy.task import Future
from turtlewire.errors import (
    ExtrapolationException,
    InvalidArgumentException,
    TransformException,
)
from turtlewire.guarded import call_guarded

if TYPE_CHECKING:
    import turtlewire
    from geometry_msgs.msg import TransformStamped


class Leg(NamedTuple):
    """A lookup between two frames at one time."""

    target: str
    source: str
    stamp_ns: int


class PendingLookup(NamedTuple):
    """A lookup that a future waits for.

    Attributes:
        engine: The buffer.
        legs: Its parts, each at one time.
        answer: Returns the transform; raises :class:`TransformException` until it is available.
    """

    engine: turtlewire.Buffer
    legs: tuple[Leg, ...]
    answer: Callable[[], TransformStamped]

    def never(self, error: TransformException) -> bool:
        """Return True if no later data can bring the answer, judged by the present error."""
        if isinstance(error, InvalidArgumentException):
            return True
        # Otherwise only a time that has left a cache cannot come back; the latest time advances
        # with the data.
        keep_ns = self.engine.cache_time_ns
        if not isinstance(error, ExtrapolationException):
            return False
        if keep_ns is None or error.reason == "future":
            return False
        latest = any(
            leg.stamp_ns == 0
            for leg in self.legs
            if (leg.target, leg.source) == (error.target_frame, error.source_frame)
        )
        if latest or error.requested_ns is None or error.newest_ns is None:
            return False
        return error.requested_ns < error.newest_ns - keep_ns


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
            self._look_at(waiting, give_up=timeout_ns == 0)
        except Exception:
            # A wrong argument: nobody has the future, and looking at it would raise again.
            self._claim(waiting)
            raise
        if timeout_ns is not None and not waiting.future.done():
            waiting.cancel_deadline = _deadlines.call_after(
                timeout_ns / 1e9, lambda: self._look_at(waiting, give_up=True)
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

    def _look_at(self, waiting: _Waiting, *, give_up: bool = False) -> None:
        try:
            result = waiting.question.answer()
        except TransformException as error:
            if give_up or waiting.question.never(error):
                self._finish(waiting, error)
        else:
            self._finish(waiting, result)

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


class Deadlines:
    """Functions to call later. Thread-safe."""

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._numbers = itertools.count()
        self._due: list[tuple[float, int]] = []
        self._calls: dict[int, Callable[[], None]] = {}
        self._running = False

    def call_after(self, seconds: float, call: Callable[[], None]) -> Callable[[], None]:
        """Call ``call()`` after some seconds, unless the returned function is called before.

        If it raises, the exception is reported, and later calls still run.
        """
        with self._condition:
            number = next(self._numbers)
            self._calls[number] = call
            heapq.heappush(self._due, (time.monotonic() + seconds, number))
            self._condition.notify()
            if not self._running:
                self._running = True
                threading.Thread(target=self._run, name="tf2-deadlines", daemon=True).start()

        def cancel() -> None:
            with self._condition:
                self._calls.pop(number, None)
                self._condition.notify()

        return cancel

    def _run(self) -> None:
        while (call := self._next()) is not None:
            call_guarded(call)

    def _next(self) -> Callable[[], None] | None:
        """Block until a call is due; None if no call is left."""
        with self._condition:
            while self._calls:
                when, number = self._due[0]
                remaining = when - time.monotonic()
                # A cancelled call stays in the heap until it is at the front.
                if number not in self._calls:
                    heapq.heappop(self._due)
                elif remaining > 0:
                    self._condition.wait(remaining)
                else:
                    heapq.heappop(self._due)
                    return self._calls.pop(number)
            # Under the lock, so that `call_after` either sees the thread wait or starts a new one.
            self._due.clear()
            self._running = False
            return None


_deadlines = Deadlines()
