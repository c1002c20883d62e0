"""Publishers and subscriptions of the in-process middleware, and their common base."""

from __future__ import annotations

import itertools
import os
import time
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import (
    EndpointInfo,
    Entity,
    EventKind,
    EventStatus,
    MessageInfo,
    Publisher,
    Subscription,
)
from turtlewire.wire.delivery import deliver
from turtlewire.wire.encapsulation import joined, require_message
from turtlewire.wire.events import StatusEvent
from turtlewire.wire.qos import Durability, History
from turtlewire.wire.queue_wait_set import Queued

if TYPE_CHECKING:
    import threading
    from collections.abc import Callable

    from turtlewire.wire.base import Event, NodeInfo, TypeId
    from turtlewire.wire.encapsulation import Cdr
    from turtlewire.wire.qos import QoS
    from turtlewire.wire.queue_wait_set import Watcher

    from .node import LocalNodeState

__all__ = [
    "EVENTS",
    "LocalEndpoint",
    "LocalEndpointSpec",
    "LocalPublisher",
    "LocalSubscription",
    "Message",
    "new_gid",
]

Message = tuple[bytes, MessageInfo]

#: What endpoints here can report.
EVENTS = frozenset({EventKind.MATCHED, EventKind.INCOMPATIBLE_QOS})

_gids = itertools.count(1)


def new_gid() -> bytes:
    """Return 16 bytes, unique on this computer: two processes may link their buses.

    The last eight identify a client, too.
    """
    return b"local\0\0\0" + os.getpid().to_bytes(4, "big") + next(_gids).to_bytes(4, "big")


class LocalEndpointSpec(NamedTuple):
    """The specification of a new endpoint.

    Attributes:
        name: ROS name of the topic, or of the service that the endpoint belongs to.
        dds_topic: Name of the topic on the wire.
        type_id: Type of the messages.
        qos: Its policies.
        service_hash: Hash of the service's type, if it is announced.
    """

    name: str
    dds_topic: str
    type_id: TypeId
    qos: QoS
    service_hash: str = ""


class LocalEndpoint(Entity):
    """The common base of publishers and subscriptions. The bus's lock guards all of it.

    Attributes:
        matched: The endpoints of the other kind that it matches.
    """

    def __init__(self, spec: LocalEndpointSpec, node: NodeInfo, lock: threading.RLock) -> None:
        self.topic = spec.name
        self.dds_topic = spec.dds_topic
        self.type_id = spec.type_id
        self.qos = spec.qos
        self.gid = new_gid()
        self.matched: list[LocalEndpoint] = []
        self._matched_count = 0
        self._incompatible_count = 0
        self._node = node
        self._service_hash = spec.service_hash
        self._lock = lock
        self._closed = False
        keep_all = spec.qos.history == History.KEEP_ALL
        self._queue: deque[Message] = deque(maxlen=None if keep_all else max(spec.qos.depth, 1))
        self._events: dict[EventKind, StatusEvent] = {}

    def create_event(self, kind: EventKind) -> Event:
        if kind not in EVENTS and kind is not EventKind.INCOMPATIBLE_TYPE:
            raise WireError(f"the in-process middleware has no event '{kind.value}'")
        return self._event(kind)

    def _event(self, kind: EventKind) -> StatusEvent:
        with self._lock:
            return self._events.setdefault(kind, StatusEvent(kind))

    def info(self, kind: str) -> EndpointInfo:
        """Return the graph's entry of this endpoint; ``kind`` as in `EndpointInfo`."""
        topic = names.topic_from_dds(self.dds_topic) or self.dds_topic
        return EndpointInfo(
            kind, topic, *self.type_id, self._node, self.gid, self.qos, self._service_hash
        )

    def kept(self) -> list[Message]:
        """Return the messages that a late joiner receives."""
        return []

    def receive(self, message: Message) -> None:
        """Take over a message; called with the lock held."""
        self._queue.append(message)

    def meet(self, other: LocalEndpoint) -> None:
        """Match an endpoint of the other kind; called with the lock held."""
        self.matched.append(other)
        self._matched_count += 1
        self._report_matched(1)

    def part(self, other: LocalEndpoint) -> None:
        """Stop matching an endpoint of the other kind; called with the lock held."""
        self.matched.remove(other)
        self._report_matched(-1)

    def _report_matched(self, change: int) -> None:
        status = EventStatus(self._matched_count, max(change, 0), len(self.matched), change)
        self._event(EventKind.MATCHED).add(status)

    def refuse(self, policy: int) -> None:
        """Report an endpoint of the other kind that does not match because of a QoS policy.

        Called with the lock held.
        """
        self._incompatible_count += 1
        status = EventStatus(self._incompatible_count, 1, last_policy_kind=policy)
        self._event(EventKind.INCOMPATIBLE_QOS).add(status)

    def close(self) -> None:
        with self._lock:
            if self._closed:
                return
            self._closed = True
            self._leave()
            self.matched.clear()
            self._queue.clear()
            for event in self._events.values():
                event.close()

    def _leave(self) -> None:
        """Take leave of the bus and the node; called with the lock held."""
        raise NotImplementedError


class LocalPublisher(LocalEndpoint, Publisher):
    """Hands its messages to the queues of the matching subscriptions."""

    def __init__(self, node: LocalNodeState, spec: LocalEndpointSpec) -> None:
        super().__init__(spec, node.info, node.bus.lock)
        self._core = node
        self._published = 0
        with self._lock:
            node.bus.add_publisher(self)
            node.endpoints.add(self)
        node.bus.changed()

    def publish(self, cdr: Cdr) -> None:
        cdr = joined(cdr)
        require_message(cdr, self.topic)
        now = time.time_ns()
        with self._lock:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            self._published += 1
            message = (cdr, MessageInfo(now, now, self.gid, self._published))
            if self._core.bus.tamper is None:
                self.deliver(message)
            else:
                self._core.bus.tamper(self, message)

    def deliver(self, message: Message) -> None:
        """Hand a message to the matching subscriptions; nothing happens after the end."""
        with self._lock:
            if self._closed:
                return
            if self.qos.durability == Durability.TRANSIENT_LOCAL:
                self._queue.append(message)
            for subscription in self.matched:
                subscription.receive(message)

    def kept(self) -> list[Message]:
        oldest = time.time_ns() - self.qos.lifespan_ns if self.qos.lifespan_ns else 0
        return [message for message in self._queue if message[1].source_timestamp_ns >= oldest]

    def subscription_count(self) -> int:
        return len(self.matched)

    def assert_liveliness(self) -> None:
        """Do nothing: publishers of one process end together."""

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:  # noqa: ARG002 - see below
        """Return True: messages arrive as they are published."""
        return True

    def _leave(self) -> None:
        self._core.endpoints.discard(self)
        self._core.bus.remove_publisher(self)
        self._core.bus.changed()


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
