"""What joins the contexts of one domain of one process: who publishes, who listens, and who matches whom."""

from __future__ import annotations

import itertools
import threading
from typing import TYPE_CHECKING

from turtlewire.wire.base import EventKind, EventStatus
from turtlewire.wire.qos import Durability, Reliability

if TYPE_CHECKING:
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


class Bus:
    """All contexts, publishers and subscriptions of a domain.

    Attributes:
        lock: Guards the state of all of them.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.contexts: list[LocalContext] = []
        self.publishers: list[LocalPublisher] = []
        self.subscriptions: list[LocalSubscription] = []

    def add_publisher(self, publisher: LocalPublisher) -> None:
        """Let it match; called with the lock held."""
        self.publishers.append(publisher)
        for subscription in self.subscriptions:
            _meet(publisher, subscription)

    def add_subscription(self, subscription: LocalSubscription) -> None:
        """Let it match; called with the lock held."""
        self.subscriptions.append(subscription)
        for publisher in self.publishers:
            _meet(publisher, subscription)

    def remove_publisher(self, publisher: LocalPublisher) -> None:
        """Let it match no more; called with the lock held."""
        self.publishers.remove(publisher)
        for subscription in publisher.matched:
            _part(subscription, publisher)

    def remove_subscription(self, subscription: LocalSubscription) -> None:
        """Let it match no more; called with the lock held."""
        self.subscriptions.remove(subscription)
        for publisher in subscription.matched:
            _part(publisher, subscription)

    def changed(self) -> None:
        """Tell every context that the graph is another one now."""
        with self.lock:
            contexts = list(self.contexts)
        for context in contexts:
            context.graph_changed()


def _meet(publisher: LocalPublisher, subscription: LocalSubscription) -> None:
    if (publisher.dds_topic, publisher.type_id.name) != (subscription.dds_topic, subscription.type_id.name):
        return
    policy = _misfit(publisher, subscription)
    if policy:
        for endpoint in (publisher, subscription):
            total = endpoint.incompatible_count = endpoint.incompatible_count + 1
            endpoint.event(EventKind.INCOMPATIBLE_QOS).add(EventStatus(total, 1, last_policy_kind=policy))
        return
    publisher.matched.append(subscription)
    subscription.matched.append(publisher)
    for endpoint in (publisher, subscription):
        endpoint.matched_count += 1
        endpoint.event(EventKind.MATCHED).add(EventStatus(endpoint.matched_count, 1, len(endpoint.matched), 1))
    subscription.receive_late(publisher)


def _misfit(publisher: LocalPublisher, subscription: LocalSubscription) -> int:
    """The policy that does not fit, or 0."""
    offered, requested = publisher.qos, subscription.qos
    if offered.reliability == Reliability.BEST_EFFORT and requested.reliability != Reliability.BEST_EFFORT:
        return _POLICY_RELIABILITY
    if offered.durability != Durability.TRANSIENT_LOCAL and requested.durability == Durability.TRANSIENT_LOCAL:
        return _POLICY_DURABILITY
    return 0


def _part(stays: LocalEndpoint, goes: LocalEndpoint) -> None:
    stays.matched.remove(goes)
    stays.event(EventKind.MATCHED).add(EventStatus(stays.matched_count, 0, len(stays.matched), -1))
