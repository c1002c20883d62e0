"""Publishers and subscriptions of the in-process middleware."""

from __future__ import annotations

import time
from collections import deque
from typing import TYPE_CHECKING, Any

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import (
    EndpointInfo,
    Entity,
    EventKind,
    MessageInfo,
    Publisher,
    Subscription,
)
from turtlewire.wire.encapsulation import require_message
from turtlewire.wire.events import StatusEvent
from turtlewire.wire.qos import Durability, History
from turtlewire.wire.report import call_guarded

from .bus import new_gid

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Event, TypeId
    from turtlewire.wire.qos import QoS

    from .context import LocalNode
    from .waiting import LocalWaitSet

__all__ = ["LocalEndpoint", "LocalPublisher", "LocalSubscription"]

_Message = tuple[bytes, MessageInfo]
_EVENTS = {EventKind.MATCHED, EventKind.INCOMPATIBLE_QOS}


class LocalEndpoint(Entity):
    """What publishers and subscriptions have in common. The bus's lock guards all of it."""

    def __init__(
        self, node: LocalNode, name: str, dds_topic: str, type_id: TypeId, qos: QoS
    ) -> None:
        self.topic = name
        self.dds_topic = dds_topic
        self.type_id = type_id
        self.qos = qos
        self.gid = new_gid()
        self.node = node
        self.bus = node.context.bus
        self.matched: list[Any] = []
        self.matched_count = 0
        self.incompatible_count = 0
        self._closed = False
        self._queue: deque[_Message] = deque(
            maxlen=None if qos.history == History.KEEP_ALL else max(qos.depth, 1)
        )
        self._events: dict[EventKind, StatusEvent] = {}

    def create_event(self, kind: EventKind) -> Event:
        """See :meth:`Publisher.create_event`."""
        if kind not in _EVENTS:
            raise WireError(f"the in-process middleware has no event '{kind.value}'")
        return self.event(kind)

    def event(self, kind: EventKind) -> StatusEvent:
        """The event of this kind."""
        with self.bus.lock:
            return self._events.setdefault(kind, StatusEvent(kind))

    def info(self, kind: str) -> EndpointInfo:
        """What the graph shows of it."""
        topic = names.topic_from_dds(self.dds_topic) or self.dds_topic
        return EndpointInfo(kind, topic, *self.type_id, self.node.info, self.gid, self.qos)

    def _join(self, add: Callable[[Any], None]) -> None:
        with self.bus.lock:
            add(self)
            self.node.endpoints.add(self)
        self.bus.changed()

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self.bus.lock:
            if self._closed:
                return
            self._closed = True
            self.node.endpoints.discard(self)
            self._leave()
            self.matched.clear()
            self._queue.clear()
            for event in self._events.values():
                event.close()
        self.bus.changed()

    def _leave(self) -> None:
        raise NotImplementedError


class LocalPublisher(LocalEndpoint, Publisher):
    """Hands its messages to the queues of the matching subscriptions."""

    def __init__(
        self, node: LocalNode, name: str, dds_topic: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(node, name, dds_topic, type_id, qos)
        self._join(self.bus.add_publisher)

    def publish(self, cdr: bytes) -> None:
        """See :meth:`Publisher.publish`."""
        require_message(cdr, self.topic)
        now = time.time_ns()
        message = (cdr, MessageInfo(now, now, self.gid))
        with self.bus.lock:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            if self.qos.durability == Durability.TRANSIENT_LOCAL:
                self._queue.append(message)
            for subscription in self.matched:
                subscription.receive(message)

    def kept(self) -> list[_Message]:
        """What a late joiner receives."""
        oldest = time.time_ns() - self.qos.lifespan_ns if self.qos.lifespan_ns else 0
        return [message for message in self._queue if message[1].source_timestamp_ns >= oldest]

    def subscription_count(self) -> int:
        """See :meth:`Publisher.subscription_count`."""
        return len(self.matched)

    def assert_liveliness(self) -> None:
        """See :meth:`Publisher.assert_liveliness`; inside one process nobody dies alone."""

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:  # noqa: ARG002 - what was published has arrived
        """See :meth:`Publisher.wait_for_acknowledgments`."""
        return True

    def _leave(self) -> None:
        self.bus.remove_publisher(self)


class LocalSubscription(LocalEndpoint, Subscription):
    """Keeps messages until they are taken."""

    def __init__(
        self,
        node: LocalNode,
        name: str,
        dds_topic: str,
        type_id: TypeId,
        qos: QoS,
        *,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
    ) -> None:
        super().__init__(node, name, dds_topic, type_id, qos)
        self._on_message = on_message
        self.wait_sets: set[LocalWaitSet] = set()
        self._join(self.bus.add_subscription)

    def receive_late(self, publisher: LocalPublisher) -> None:
        """Take over what a newly matched publisher keeps for late joiners.

        Called with the lock held.
        """
        if self.qos.durability == Durability.TRANSIENT_LOCAL:
            for message in publisher.kept():
                self.receive(message)

    def receive(self, message: _Message) -> None:
        """Take over a message; called with the lock held."""
        self._queue.append(message)
        if self._on_message is not None:
            self.node.context.reader.submit(self._deliver)
        for wait_set in self.wait_sets:
            wait_set.notify()

    def _deliver(self) -> None:
        """On the reader thread: hand over all waiting messages."""
        assert self._on_message is not None
        for message in self.take(limit=len(self._queue)):
            call_guarded(self._on_message, message, self.topic)

    @property
    def is_ready(self) -> bool:
        """Whether messages are waiting."""
        return bool(self._queue)

    def take(self, limit: int = 32) -> list[_Message]:
        """See :meth:`Subscription.take`."""
        with self.bus.lock:
            return [self._queue.popleft() for _ in range(min(limit, len(self._queue)))]

    def publisher_count(self) -> int:
        """See :meth:`Subscription.publisher_count`."""
        return len(self.matched)

    def _leave(self) -> None:
        self.bus.remove_subscription(self)
        for wait_set in list(self.wait_sets):
            wait_set.detach(self)
