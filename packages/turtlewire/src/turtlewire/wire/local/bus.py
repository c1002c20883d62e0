"""The endpoints, nodes and contexts of one domain of one process, and which endpoints match."""

from __future__ import annotations

import itertools
import os
import threading
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, Protocol

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import (
    EndpointInfo,
    Entity,
    EventKind,
    EventStatus,
    MessageInfo,
)
from turtlewire.wire.conflicts import EndpointTypes, as_compared
from turtlewire.wire.events import EventSource
from turtlewire.wire.qos import Durability, History, Reliability

if TYPE_CHECKING:
    from turtlewire.wire.base import Event, NodeInfo, TypeId
    from turtlewire.wire.qos import QoS

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


class LocalEndpoint(EventSource, Entity):
    """The common base of publishers and subscriptions. The bus's lock guards all of it.

    Attributes:
        matched: The endpoints of the other kind that it matches.
    """

    def __init__(self, spec: LocalEndpointSpec, node: NodeInfo, lock: threading.RLock) -> None:
        super().__init__(lock)
        self.topic = spec.name
        self.dds_topic = spec.dds_topic
        self.type_id = spec.type_id
        self.qos = spec.qos
        self.gid = new_gid()
        self.matched: list[LocalEndpoint] = []
        self._incompatible_count = 0
        self._node = node
        self._service_hash = spec.service_hash
        self._closed = False
        self._process = os.getpid()
        keep_all = spec.qos.history == History.KEEP_ALL
        self._queue: deque[Message] = deque(maxlen=None if keep_all else max(spec.qos.depth, 1))

    def create_event(self, kind: EventKind) -> Event:
        if kind not in EVENTS and kind is not EventKind.INCOMPATIBLE_TYPE:
            raise WireError(f"the in-process middleware has no event '{kind.value}'")
        return self._event(kind)

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
        self._report_matched(1, len(self.matched))

    def part(self, other: LocalEndpoint) -> None:
        """Stop matching an endpoint of the other kind; called with the lock held."""
        self.matched.remove(other)
        self._report_matched(-1, len(self.matched))

    def refuse(self, policy: int) -> None:
        """Report an endpoint of the other kind that does not match because of a QoS policy.

        Called with the lock held.
        """
        self._incompatible_count += 1
        status = EventStatus(self._incompatible_count, 1, last_policy_kind=policy)
        self._event(EventKind.INCOMPATIBLE_QOS).add(status)

    def close(self) -> None:
        if self._process != os.getpid():  # see `Entity.close`
            return
        with self._lock:
            if self._closed:
                return
            self._closed = True
            self._leave()
            self.matched.clear()
            self._queue.clear()
            self._close_events()

    def _leave(self) -> None:
        """Take leave of the bus and the node; called with the lock held."""
        raise NotImplementedError


_POLICY_DURABILITY, _POLICY_RELIABILITY = 2, 16

_buses: dict[int, Bus] = {}
_buses_lock = threading.Lock()


def bus_of(domain_id: int) -> Bus:
    """Return the one bus of a domain."""
    with _buses_lock:
        return _buses.setdefault(domain_id, Bus())


class LocalSender(Protocol):
    """A publisher, as :attr:`Bus.tamper` sees it.

    Attributes:
        topic: ROS name of its topic.
    """

    topic: str

    def deliver(self, message: Message) -> None:
        """Hand a message to the matching subscriptions; nothing happens after the end."""


class _Topic(NamedTuple):
    """The endpoints of one topic and type, in the order of their creation."""

    publishers: dict[LocalEndpoint, None]
    subscriptions: dict[LocalEndpoint, None]


class Bus:
    """All nodes, publishers and subscriptions of a domain.

    Attributes:
        lock: Guards the state of all of them.
        nodes: The open nodes, in the order of their creation.
        listeners: Called when the graph has changed.
        tamper: For tests of faults: called with each message instead of delivering it; calls
            :meth:`LocalSender.deliver` with what is to arrive. None delivers all.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.nodes: list[NodeInfo] = []
        self.listeners: list[Callable[[], None]] = []
        self.tamper: Callable[[LocalSender, Message], None] | None = None
        self._types = EndpointTypes()
        self._topics: dict[tuple[str, str], _Topic] = {}

    def publishers(self) -> list[LocalEndpoint]:
        """Return all of them; called with the lock held."""
        return [publisher for topic in self._topics.values() for publisher in topic.publishers]

    def subscriptions(self) -> list[LocalEndpoint]:
        """Return all of them; called with the lock held."""
        return [
            subscription for topic in self._topics.values() for subscription in topic.subscriptions
        ]

    def _topic_of(self, endpoint: LocalEndpoint) -> _Topic:
        return self._topics.setdefault((endpoint.dds_topic, endpoint.type_id.name), _Topic({}, {}))

    def add_publisher(self, publisher: LocalEndpoint) -> None:
        """Let it match; called with the lock held."""
        topic = self._topic_of(publisher)
        topic.publishers[publisher] = None
        self._compare_types(self._types.add, publisher, "publisher")
        for subscription in topic.subscriptions:
            _meet(publisher, subscription)

    def add_subscription(self, subscription: LocalEndpoint) -> None:
        """Let it match; called with the lock held."""
        topic = self._topic_of(subscription)
        topic.subscriptions[subscription] = None
        self._compare_types(self._types.add, subscription, "subscription")
        for publisher in topic.publishers:
            _meet(publisher, subscription)

    def remove_publisher(self, publisher: LocalEndpoint) -> None:
        """Let it match no more; called with the lock held."""
        del self._topic_of(publisher).publishers[publisher]
        self._compare_types(self._types.remove, publisher, "publisher")
        for subscription in publisher.matched:
            subscription.part(publisher)
        self._forget_if_empty(publisher)

    def remove_subscription(self, subscription: LocalEndpoint) -> None:
        """Let it match no more; called with the lock held."""
        del self._topic_of(subscription).subscriptions[subscription]
        self._compare_types(self._types.remove, subscription, "subscription")
        for publisher in subscription.matched:
            publisher.part(subscription)
        self._forget_if_empty(subscription)

    def _compare_types(
        self, change: Callable[..., None], endpoint: LocalEndpoint, kind: str
    ) -> None:
        compared = as_compared(endpoint.dds_topic, kind, endpoint.type_id.name)
        if compared is not None:
            change(*compared, own=True)

    def _forget_if_empty(self, endpoint: LocalEndpoint) -> None:
        topic = self._topic_of(endpoint)
        if not topic.publishers and not topic.subscriptions:
            del self._topics[endpoint.dds_topic, endpoint.type_id.name]

    def changed(self) -> None:
        """Call the listeners."""
        with self.lock:
            listeners = list(self.listeners)
        for listener in listeners:
            listener()


def _meet(publisher: LocalEndpoint, subscription: LocalEndpoint) -> None:
    """Match two endpoints of one topic and type, or report which policy does not fit."""
    policy = _misfit(publisher, subscription)
    if policy:
        publisher.refuse(policy)
        subscription.refuse(policy)
        return
    publisher.meet(subscription)
    subscription.meet(publisher)


def _misfit(publisher: LocalEndpoint, subscription: LocalEndpoint) -> int:
    """Return the policy that does not fit, or 0."""
    offered, requested = publisher.qos, subscription.qos
    if (
        offered.reliability == Reliability.BEST_EFFORT
        and requested.reliability != Reliability.BEST_EFFORT
    ):
        return _POLICY_RELIABILITY
    if (
        offered.durability != Durability.TRANSIENT_LOCAL
        and requested.durability == Durability.TRANSIENT_LOCAL
    ):
        return _POLICY_DURABILITY
    return 0
