"""The contexts, nodes and endpoints of one domain of one process, and which endpoints match."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, NamedTuple, Protocol

from turtlewire.wire.conflicts import EndpointTypes, as_compared
from turtlewire.wire.qos import Durability, Reliability

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import NodeInfo

    from .endpoint import LocalEndpoint, Message

__all__ = ["Bus", "LocalSender", "bus_of"]

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
