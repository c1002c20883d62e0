"""The wait of an executor: for endpoints with messages, and for timers."""

from __future__ import annotations

import threading
import weakref
from collections import deque
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

from .timer_queue import TimerQueue

if TYPE_CHECKING:
    from turtlewire.wire import base

    from .membership import Membership


class _Ranked(Protocol):
    """An object that the wait can report as ready."""

    _rank: tuple[int, int, int]
    _membership: Membership | None


T = TypeVar("T", bound=_Ranked)
_BY_RANK = attrgetter("_rank")


class ExecutorWait(Generic[T]):
    """One wait for everything; one thread waits at a time, all other methods are thread-safe.

    Args:
        wait_set: The middleware's wait set, which this owns.

    Attributes:
        timers: When each timer is due.
        background: Messages that other threads handle; see :meth:`expect_background`.
    """

    def __init__(self, wait_set: base.WaitSet) -> None:
        self.timers: TimerQueue[Any] = TimerQueue(wait_set.wake)
        self.background: set[Any] = set()  # of BackgroundEvents
        self._wait_set = wait_set
        self._by_wire: dict[Any, T] = {}  # the key is a `base.Waitable`
        # Their endpoints are still attached. Closing an endpoint detaches it.
        self._parked: set[weakref.ref[Membership]] = set()
        # Also held by finalizers, which run in the middle of anything.
        self._lock = threading.RLock()
        self._notified: deque[T] = deque()
        self._waker = wait_set.native_waker()
        self._expecting = False
        self._waiting = False
        self._ended = False

    def watch(self, wire: base.Waitable, entity: T) -> None:
        """Report ``entity`` when its side on the wire has something."""
        with self._lock:
            self._by_wire[wire] = entity
            self._wait_set.attach(wire)

    def unwatch(self, wire: base.Waitable) -> None:
        """Undo :meth:`watch`."""
        with self._lock:
            if self._by_wire.pop(wire, None) is not None:
                self._wait_set.detach(wire)

    def park(self, membership: Membership) -> None:
        """Report the endpoints of a node no longer, but detach them only before the next wait.

        So a loop of ``rclpy.spin_once``, which removes the node after each call and adds it again
        before the next one, leaves the middleware's wait set as it is.
        """
        with self._lock:
            if membership.by_wire is None:
                membership.by_wire = {
                    wire: entity
                    for wire, entity in self._by_wire.items()
                    if entity._membership is membership
                }
                watched = set(membership.by_wire.values())
                membership.others = [each for each in membership.entities if each not in watched]
            for wire in membership.by_wire:
                self._by_wire.pop(wire, None)
            self._parked.add(weakref.ref(membership))

    def take_back(self, membership: Membership) -> bool:
        """Undo :meth:`park`; False if the endpoints have been detached."""
        reference = weakref.ref(membership)
        with self._lock:
            if membership.by_wire is None or reference not in self._parked:
                return False
            self._parked.discard(reference)
            self._by_wire.update(membership.by_wire)
            return True

    def detach_parked(self) -> None:
        """Detach the endpoints of nodes that were not taken back."""
        with self._lock:
            while self._parked:
                membership = self._parked.pop()()
                if membership is None:  # its node is gone, and the endpoints are closed
                    continue
                for wire in membership.by_wire or ():
                    self._wait_set.detach(wire)

    def notify(self, entity: T) -> None:
        """Report ``entity`` at once."""
        self._notified.append(entity)
        self.wake()

    def expect_background(self) -> None:
        """End the wait at the next message that another thread handles."""
        for events in list(self.background):
            events.expect(self._waker)
        self._expecting = True

    def wake(self) -> None:
        """End the current wait, or the next one at once."""
        self._wait_set.wake()

    def wait(self, timeout_ns: int | None) -> list[T]:
        """Block until something is ready, at most ``timeout_ns`` (None: no limit).

        Returns:
            What is ready, in ROS 2's order.
        """
        if self._parked:
            self.detach_parked()
        # The middleware is still checked: its ready entities belong to the same cycle.
        if self._notified:
            timeout_ns = 0
        else:
            until_timer = self.timers.time_until_next()
            if until_timer is not None and (timeout_ns is None or until_timer < timeout_ns):
                timeout_ns = until_timer
        entities = self._wait_for_wire(timeout_ns)
        entities += self.timers.pop_due()
        while self._notified:
            entities.append(self._notified.popleft())
        if self._expecting:
            # Native code ends the wait without a report; events without arrivals do no work.
            self._expecting = False
            entities += self.background
        if len(entities) > 1:
            entities.sort(key=_BY_RANK)
        return entities

    def _wait_for_wire(self, timeout_ns: int | None) -> list[T]:
        self._waiting = True
        try:
            ready = [] if self._ended else self._wait_set.wait(timeout_ns)
        finally:
            self._waiting = False
            # `close` left this to the thread that was in the wait set.
            if self._ended:
                self._wait_set.close()
        if not ready:
            return []
        # one look at the table for each: another thread may unwatch it at any moment
        return [entity for wire in ready if (entity := self._by_wire.get(wire)) is not None]

    def end(self) -> None:
        """Wait no more: the current wait ends, and later ones return at once."""
        self._ended = True
        self.wake()

    def close(self) -> None:
        """Release the wait set after :meth:`end`; a thread that still waits does it instead."""
        if not self._waiting:
            self._wait_set.close()
