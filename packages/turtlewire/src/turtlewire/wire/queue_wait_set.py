"""Wait sets of middlewares whose messages wait in queues of Python."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from turtlewire.errors import WireError
from turtlewire.wake_up import seconds_of

from .base import Entity, WaitSet
from .events import EventWatcher, StatusEvent
from .services import TopicClient, TopicService

if TYPE_CHECKING:
    from collections import deque

    from .base import Waitable


class Watcher(Protocol):
    """Something that waits for an entity."""

    def detach(self, entity: Any, /) -> None:
        """Wait no more; a closing entity calls it."""
        ...


class Queued(Entity):
    """An entity with a queue, which the lock guards.

    Attributes:
        topic: ROS name of its topic or service.
        watchers: What waits for it, and what to call, with the lock held, when something was
            queued.
    """

    topic: str
    watchers: dict[Watcher, Callable[[], None]]
    _queue: deque[Any]
    _lock: threading.Lock | threading.RLock
    _closed: bool

    def tell_watchers(self) -> None:
        """Tell them that something was queued; call it with the lock held."""
        for notify in list(self.watchers.values()):  # one that is told may leave
            notify()

    def leave_watchers(self) -> None:
        """Detach the wait sets."""
        for watcher in list(self.watchers):
            watcher.detach(self)

    @property
    def is_waiting(self) -> bool:
        """True if something waits to be taken."""
        return bool(self._queue)

    def take(self, limit: int = 32) -> list[Any]:
        """Take up to ``limit`` of what waits, oldest first."""
        with self._lock:
            return [self._queue.popleft() for _ in range(min(limit, len(self._queue)))]

    def require_open(self) -> None:
        """Make sure that messages can still arrive.

        Raises:
            WireError: The entity is closed.
        """
        if self._closed:
            raise WireError(f"wait for {self.topic}: it is closed")


class QueueWaitSet(EventWatcher, WaitSet):
    """Waits on a condition variable over the lock of the queues.

    Args:
        lock: Guards the queues of all entities that are attached.
        on_closing: Called when it is closed.
    """

    def __init__(self, lock: threading.RLock, on_closing: Callable[[QueueWaitSet], None]) -> None:
        super().__init__()
        self._on_closing = on_closing
        # `with` takes the lock itself, which a signal cannot leave locked; see `wake_up`.
        self._lock = lock
        self._condition = threading.Condition(lock)
        self._attached: dict[Queued, Entity] = {}
        self._woken = False
        self._closed = False
        self._process = os.getpid()

    def attach(self, entity: Waitable) -> None:
        if isinstance(entity, StatusEvent):
            entity.attach(self)
            return
        queue = _queue_of(entity)
        with self._lock:
            queue.watchers[self] = self.notify
            self._attached[queue] = entity
            self._condition.notify_all()

    def detach(self, entity: Waitable) -> None:
        if isinstance(entity, StatusEvent):
            entity.detach(self)
            return
        queue = _queue_of(entity)
        with self._lock:
            self._attached.pop(queue, None)
            queue.watchers.pop(self, None)

    def notify(self) -> None:
        """A message came for an attached subscription; called with the lock held."""
        self._condition.notify_all()

    def wait(self, timeout_ns: int | None = None) -> list[Entity]:
        with self._lock:
            self._condition.wait_for(self._has_news, seconds_of(timeout_ns))
            self._woken = self._closed
            ready: list[Entity] = [
                entity for queue, entity in self._attached.items() if queue.is_waiting
            ]
            return ready + self.ready_events()

    def _has_news(self) -> bool:
        return (
            self._woken
            or any(queue.is_waiting for queue in self._attached)
            or bool(self.ready_events())
        )

    def wake(self) -> None:
        with self._lock:
            self._woken = True
            self._condition.notify_all()

    def close(self) -> None:
        if self._process != os.getpid():  # see `Entity.close`
            return
        self._on_closing(self)
        self.leave_events()
        with self._lock:
            self._closed = True
            for queue in self._attached:
                queue.watchers.pop(self, None)
            self._attached.clear()
            self.wake()


class _Call:
    """Calls a function when something is queued, once."""

    def __init__(self, queue: Queued, call: Callable[[], None]) -> None:
        self._queue = queue
        self._call = call

    def notify(self) -> None:
        """Something was queued; called with the lock held."""
        self.detach(self._queue)
        self._call()

    def detach(self, _entity: object) -> None:
        self._queue.watchers.pop(self, None)


def call_when_queued(
    lock: threading.RLock, entity: Waitable, call: Callable[[], None]
) -> Callable[[], None]:
    """Do what :meth:`turtlewire.wire.base.Context.call_when_ready` says."""
    queue = _queue_of(entity)
    once = _Call(queue, call)
    with lock:
        queue.require_open()
        queue.watchers[once] = once.notify
        if queue.is_waiting:
            once.notify()

    def take_back() -> None:
        with lock:
            once.detach(queue)

    return take_back


def _queue_of(entity: Waitable) -> Queued:
    if isinstance(entity, TopicClient):
        entity = entity.replies
    elif isinstance(entity, TopicService):
        entity = entity.requests
    assert isinstance(entity, Queued)
    return entity
