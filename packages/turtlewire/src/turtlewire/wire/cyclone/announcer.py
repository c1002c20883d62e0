"""Announces the nodes of this participant and their endpoints (``ros_discovery_info``)."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

from turtlewire.wire.graph import (
    DISCOVERY_TOPIC,
    DISCOVERY_TYPE,
    NodeEndpoints,
    pack_discovery_info,
)
from turtlewire.wire.qos import Durability, QoS

from .endpoint import EndpointSpec
from .publisher import CyclonePublisher

if TYPE_CHECKING:
    from .participant import Participant
    from .reader import CycloneReaderThread

#: The first change is announced at once, the next ones not sooner than this after it: a thousand
#: endpoints take a few samples.
ANNOUNCEMENT_INTERVAL_NS = 20_000_000


class NodeRecord:
    """The announcement of one node.

    Its owner adds and removes gids and then calls :meth:`Announcer.changed`.
    """

    def __init__(self, namespace: str, name: str) -> None:
        self.namespace = namespace
        self.name = name
        self.readers: list[bytes] = []
        self.writers: list[bytes] = []


class Announcer:
    """Publishes the nodes of this participant after they changed."""

    def __init__(self, participant: Participant, reader: CycloneReaderThread) -> None:
        qos = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
        self._publisher = CyclonePublisher(
            participant, EndpointSpec(DISCOVERY_TOPIC, DISCOVERY_TOPIC, DISCOVERY_TYPE, qos)
        )
        self._participant = participant
        self._reader = reader
        self._lock = threading.Lock()
        self._records: list[NodeRecord] = []
        self._scheduled = False
        self._not_before = 0
        # Readers of the graph wait for each participant, including participants without nodes.
        reader.call_at(time.monotonic_ns() + ANNOUNCEMENT_INTERVAL_NS, self._publish_first)

    def add(self, record: NodeRecord) -> None:
        """Announce a node."""
        with self._lock:
            self._records.append(record)
        self.changed()

    def remove(self, record: NodeRecord) -> None:
        """Announce that a node has gone."""
        with self._lock:
            self._records.remove(record)
        self.changed()

    def changed(self) -> None:
        """Announce soon what the records say then."""
        with self._lock:
            if self._scheduled:
                return
            self._scheduled = True
            when = self._not_before
        self._reader.call_at(when, self._publish)

    def nodes(self) -> list[NodeEndpoints]:
        """Return the nodes of this participant."""
        with self._lock:
            return [
                NodeEndpoints(
                    record.namespace, record.name, tuple(record.readers), tuple(record.writers)
                )
                for record in self._records
            ]

    def _publish_first(self) -> None:
        if not self._not_before:
            self.changed()

    def _publish(self) -> None:
        """Publish the announcement; runs on the reader thread."""
        with self._lock:
            self._scheduled = False
            self._not_before = time.monotonic_ns() + ANNOUNCEMENT_INTERVAL_NS
        self._publisher.publish(pack_discovery_info(self._participant.gid, self.nodes()))

    def close(self) -> None:
        """Stop announcing; the reader thread has ended before."""
        self._publisher.close()
