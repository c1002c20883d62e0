"""Wait sets of the in-process middleware."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from turtlewire.wire.base import Entity, WaitSet
from turtlewire.wire.events import EventWatcher, StatusEvent
from turtlewire.wire.services import TopicClient, TopicService

from .subscription import LocalSubscription

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Waitable

__all__ = ["LocalWaitSet"]


class LocalWaitSet(EventWatcher, WaitSet):
    """Waits on a condition variable over the bus's lock.

    Args:
        lock: The bus's lock.
        on_closing: Called when it is closed.
    """

    def __init__(self, lock: threading.RLock, on_closing: Callable[[LocalWaitSet], None]) -> None:
        super().__init__()
        self._on_closing = on_closing
        self._condition = threading.Condition(lock)
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
            subscription.watchers[self] = self.notify
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
            subscription.watchers.pop(self, None)

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
