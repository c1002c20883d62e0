"""Wait sets and the reader thread of the in-process middleware."""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING

from turtlewire.wire.base import Entity, WaitSet
from turtlewire.wire.events import EventWatcher, StatusEvent
from turtlewire.wire.services import TopicClient, TopicService

from .endpoints import LocalSubscription

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Waitable

    from .bus import Bus

__all__ = ["LocalWaitSet", "ReaderThread"]


class LocalWaitSet(EventWatcher, WaitSet):
    """Waits on a condition variable over the bus's lock."""

    def __init__(self, bus: Bus, on_closing: Callable[[LocalWaitSet], None]) -> None:
        super().__init__()
        self._on_closing = on_closing
        self._condition = threading.Condition(bus.lock)
        self._attached: dict[LocalSubscription, Entity] = {}
        self._woken = False
        self._closed = False

    def attach(self, entity: Waitable) -> None:
        """See :meth:`WaitSet.attach`."""
        if isinstance(entity, StatusEvent):
            entity.attach(self)
            return
        subscription = _readable_part(entity)
        with self._condition:
            subscription.wait_sets.add(self)
            self._attached[subscription] = entity
            self._condition.notify_all()

    def detach(self, entity: Waitable) -> None:
        """See :meth:`WaitSet.detach`."""
        if isinstance(entity, StatusEvent):
            entity.detach(self)
            return
        subscription = _readable_part(entity)
        with self._condition:
            self._attached.pop(subscription, None)
            subscription.wait_sets.discard(self)

    def notify(self) -> None:
        """A message came for an attached subscription; called with the bus locked."""
        self._condition.notify_all()

    def wait(self, timeout_ns: int | None = None) -> list[Entity]:
        """See :meth:`WaitSet.wait`."""
        with self._condition:
            self._condition.wait_for(
                self._has_news, None if timeout_ns is None else timeout_ns / 1e9
            )
            self._woken = self._closed
            ready: list[Entity] = [
                entity for subscription, entity in self._attached.items() if subscription.is_ready
            ]
            return ready + self.ready_events()

    def _has_news(self) -> bool:
        return (
            self._woken
            or any(subscription.is_ready for subscription in self._attached)
            or bool(self.ready_events())
        )

    def wake(self) -> None:
        """See :meth:`WaitSet.wake`."""
        with self._condition:
            self._woken = True
            self._condition.notify_all()

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        self._on_closing(self)
        with self._condition:
            self._closed = True
            for subscription in list(self._attached):
                self.detach(subscription)
            self.wake()


def _readable_part(entity: Waitable) -> LocalSubscription:
    if isinstance(entity, TopicClient):
        entity = entity.replies
    elif isinstance(entity, TopicService):
        entity = entity.requests
    assert isinstance(entity, LocalSubscription)
    return entity


class ReaderThread:
    """Runs what is submitted, in order, on one thread that starts with the first submission."""

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._work: deque[Callable[[], None]] = deque()
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""
        with self._condition:
            if self._closed:
                return
            self._work.append(work)
            self._condition.notify()
            if self._thread is None:
                self._thread = threading.Thread(
                    target=self._run, name="turtlewire-reader", daemon=True
                )
                self._thread.start()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._work or self._closed)
                if self._closed:
                    return
                work = self._work.popleft()
            work()

    def close(self) -> None:
        """End the thread and join it, unless this is it."""
        with self._condition:
            self._closed = True
            self._condition.notify()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()
