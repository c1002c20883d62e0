"""The common base of publishers and subscriptions of the in-process middleware."""

from __future__ import annotations

import itertools
import os
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
)
from turtlewire.wire.events import StatusEvent
from turtlewire.wire.qos import History

if TYPE_CHECKING:
    import threading

    from turtlewire.wire.base import Event, NodeInfo, TypeId
    from turtlewire.wire.qos import QoS


__all__ = [
    "EVENTS",
    "LocalEndpoint",
    "LocalEndpointSpec",
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
