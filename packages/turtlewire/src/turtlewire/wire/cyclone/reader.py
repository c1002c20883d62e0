"""The reader thread of a context.

It serves subscriptions with ``on_message``, and everything about the graph.
"""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections import deque
from collections.abc import Callable

from turtlewire.guarded import call_guarded

from .waiting import ConditionSet


class CycloneReaderThread:
    """Waits in C for all of its conditions and calls the function of each one that is triggered.

    The functions run one after the other, without locks held; each must take what triggered it.
    If one raises, that is reported, and the others run.
    """

    def __init__(self, participant: int) -> None:
        self._conditions: ConditionSet[Callable[[], None]] = ConditionSet(participant)
        self._lock = threading.Lock()
        self._timers: list[tuple[int, int, Callable[[], None]]] = []
        self._numbers = itertools.count()
        self._soon: deque[Callable[[], None]] = deque()
        self._closed = False
        self._thread = threading.Thread(target=self._run, name="turtlewire-reader", daemon=True)
        self._thread.start()

    def watch(self, condition: int, call: Callable[[], None]) -> None:
        """Call ``call`` when the condition, or an enabled status of the entity, is triggered."""
        self._conditions.attach(condition, call)

    def unwatch(self, condition: int) -> None:
        """Stop; a call that runs already may still be running when this returns."""
        self._conditions.detach(condition)

    def call_at(self, when_ns: int, call: Callable[[], None]) -> None:
        """Call ``call`` once when ``time.monotonic_ns()`` has reached ``when_ns``."""
        with self._lock:
            # The number orders calls of one time; functions cannot be compared.
            heapq.heappush(self._timers, (when_ns, next(self._numbers), call))
        self._conditions.wake()

    def call_soon(self, call: Callable[[], None]) -> None:
        """Call ``call`` once. Takes no lock, so a finalizer may use it."""
        self._soon.append(call)
        self._conditions.wake()

    def _run(self) -> None:
        while not self._closed:
            self._call_each(self._conditions.wait(self._time_to_next()))
            self._call_each(self._due())
            # Only the calls that are there now: one of them may add itself again.
            self._call_each([self._soon.popleft() for _ in range(len(self._soon))])

    def _call_each(self, calls: list[Callable[[], None]]) -> None:
        for call in calls:
            if self._closed:  # by one of them: what the others are about has been deleted
                return
            call_guarded(call)

    def _time_to_next(self) -> int | None:
        with self._lock:
            return max(0, self._timers[0][0] - time.monotonic_ns()) if self._timers else None

    def _due(self) -> list[Callable[[], None]]:
        due = []
        now = time.monotonic_ns()
        with self._lock:
            while self._timers and self._timers[0][0] <= now:
                due.append(heapq.heappop(self._timers)[2])
        return due

    def close(self) -> None:
        """End the thread and join it, unless this is it."""
        self._closed = True
        self._conditions.wake()
        if self._thread is not threading.current_thread():
            self._thread.join()
        # Last, because the thread waits in them.
        self._conditions.close()
