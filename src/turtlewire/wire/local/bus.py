"""What joins the contexts of one domain of one process.

Who publishes, who listens, and who matches whom.
"""

from __future__ import annotations

import itertools
import threading
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.wire import names
from turtlewire.wire.base import EventKind, EventStatus
from turtlewire.wire.conflicts import TopicTypes
from turtlewire.wire.qos import Durability, Reliability

if TYPE_CHECKING:
    from collections.abc import Callable

    from .context import LocalContext
    from .endpoints import LocalEndpoint, LocalPublisher, LocalSubscription

__all__ = ["Bus", "bus_of", "new_gid"]

_POLICY_DURABILITY, _POLICY_RELIABILITY = 2, 16

_gids = itertools.count(1)
_buses: dict[int, Bus] = {}
_buses_lock = threading.Lock()


def new_gid() -> bytes:
    """16 bytes that nobody else in this process has."""
    return b"local" + next(_gids).to_bytes(11, "big")


def bus_of(domain_id: int) -> Bus:
    """The one bus of a domain."""
    with _buses_lock:
        return _buses.setdefault(domain_id, Bus())


class _Topic(NamedTuple):
    """The endpoints of one topic and type, in the order of their creation."""

    publishers: dict[LocalPublisher, None]
    subscriptions: dict[LocalSubscription, None]


class Bus:
    """All contexts, publishers and subscriptions of a domain.

    Attributes:
        lock: Guards the state of all of them.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.contexts: list[LocalContext] = []
        self._types = TopicTypes()
        self._topics: dict[tuple[str, str], _Topic] = {}

    def publishers(self) -> list[LocalPublisher]:
        """All of them; called with the lock held."""
        return [publisher for topic in self._topics.values() for publisher in topic.publishers]

    def subscriptions(self) -> list[LocalSubscription]:
        """All of them; called with the lock held."""
        return [
            subscription for topic in self._topics.values() for subscription in topic.subscriptions
        ]

    def _topic_of(self, endpoint: LocalEndpoint) -> _Topic:
        return self._topics.setdefault((endpoint.dds_topic, endpoint.type_id.name), _Topic({}, {}))

    def add_publisher(self, publisher: LocalPublisher) -> None:
        """Let it match; called with the lock held."""
        topic = self._topic_of(publisher)
        topic.publishers[publisher] = None
        self._compare_types(self._types.add, publisher, "publisher")
        for subscription in topic.subscriptions:
            _meet(publisher, subscription)

    def add_subscription(self, subscription: LocalSubscription) -> None:
        """Let it match; called with the lock held."""
        topic = self._topic_of(subscription)
        topic.subscriptions[subscription] = None
        self._compare_types(self._types.add, subscription, "subscription")
        for publisher in topic.publishers:
            _meet(publisher, subscription)

    def remove_publisher(self, publisher: LocalPublisher) -> None:
        """Let it match no more; called with the lock held."""
        del self._topic_of(publisher).publishers[publisher]
        self._compare_types(self._types.remove, publisher, "publisher")
        for subscription in publisher.matched:
            _part(subscription, publisher)
        self._forget_if_empty(publisher)

    def remove_subscription(self, subscription: LocalSubscription) -> None:
        """Let it match no more; called with the lock held."""
        del self._topic_of(subscription).subscriptions[subscription]
        self._compare_types(self._types.remove, subscription, "subscription")
        for publisher in subscription.matched:
            _part(publisher, subscription)
        self._forget_if_empty(subscription)

    def _compare_types(
        self, change: Callable[..., None], endpoint: LocalEndpoint, kind: str
    ) -> None:
        topic = names.topic_from_dds(endpoint.dds_topic)
        if topic is not None:
            change(topic, kind, endpoint.type_id.name, own=True)

    def _forget_if_empty(self, endpoint: LocalEndpoint) -> None:
        topic = self._topic_of(endpoint)
        if not topic.publishers and not topic.subscriptions:
            del self._topics[endpoint.dds_topic, endpoint.type_id.name]

    def changed(self) -> None:
        """Tell every context that the graph is another one now."""
        with self.lock:
            contexts = list(self.contexts)
        for context in contexts:
            context.graph_changed()


def _meet(publisher: LocalPublisher, subscription: LocalSubscription) -> None:
    """Match two endpoints of one topic and type, or say which policy does not fit."""
    policy = _misfit(publisher, subscription)
    if policy:
        for endpoint in (publisher, subscription):
            total = endpoint.incompatible_count = endpoint.incompatible_count + 1
            endpoint.event(EventKind.INCOMPATIBLE_QOS).add(
                EventStatus(total, 1, last_policy_kind=policy)
            )
        return
    publisher.matched.append(subscription)
    subscription.matched.append(publisher)
    for endpoint in (publisher, subscription):
        endpoint.matched_count += 1
        endpoint.event(EventKind.MATCHED).add(
            EventStatus(endpoint.matched_count, 1, len(endpoint.matched), 1)
        )
    subscription.receive_late(publisher)


def _misfit(publisher: LocalPublisher, subscription: LocalSubscription) -> int:
    """The policy that does not fit, or 0."""
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


def _part(stays: LocalEndpoint, goes: LocalEndpoint) -> None:
    stays.matched.remove(goes)
    stays.event(EventKind.MATCHED).add(EventStatus(stays.matched_count, 0, len(stays.matched), -1))
