"""Subscriptions of the in-process middleware."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.wire.base import MessageInfo, Subscription
from turtlewire.wire.delivery import deliver
from turtlewire.wire.qos import Durability
from turtlewire.wire.queue_wait_set import Queued

from .endpoint import LocalEndpoint

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.queue_wait_set import Watcher

    from .endpoint import LocalEndpointSpec, Message
    from .node_state import LocalNodeState

__all__ = ["LocalSubscription"]


class LocalSubscription(LocalEndpoint, Queued, Subscription):
    """Keeps messages until they are taken.

    Attributes:
        watchers: What waits for it, and what to call when a message arrives.
    """

    def __init__(
        self,
        node: LocalNodeState,
        spec: LocalEndpointSpec,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
    ) -> None:
        super().__init__(spec, node.info, node.bus.lock)
        self._core = node
        self._on_message = on_message
        self.watchers: dict[Watcher, Callable[[], None]] = {}
        with self._lock:
            node.bus.add_subscription(self)
            node.endpoints.add(self)
        node.bus.changed()

    def meet(self, other: LocalEndpoint) -> None:
        super().meet(other)
        if self.qos.durability == Durability.TRANSIENT_LOCAL:
            for message in other.kept():
                self.receive(message)

    def receive(self, message: Message) -> None:
        self._queue.append(message)
        if self._on_message is not None:
            self._core.reader.submit(self._deliver)
        self.tell_watchers()

    def _deliver(self) -> None:
        """Hand over all waiting messages; on the reader thread."""
        assert self._on_message is not None
        deliver(self.take(limit=len(self._queue)), self._on_message, lambda: self._closed)

    @property
    def is_waiting(self) -> bool:
        """True if messages are waiting."""
        return bool(self._queue)

    def take(self, limit: int = 32) -> list[Message]:
        with self._lock:
            return [self._queue.popleft() for _ in range(min(limit, len(self._queue)))]

    def publisher_count(self) -> int:
        return len(self.matched)

    def _leave(self) -> None:
        self._core.endpoints.discard(self)
        self._core.bus.remove_subscription(self)
        self._core.bus.changed()
        for watcher in list(self.watchers):
            watcher.detach(self)
