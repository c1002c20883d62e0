"""Contexts and the graph of the in-process middleware."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.platforms import in_browser
from turtlewire.wire.base import Context, EndpointInfo, NodeInfo
from turtlewire.wire.graph import GraphView
from turtlewire.wire.queue_wait_set import QueueWaitSet, call_when_queued
from turtlewire.wire.reader_thread import LoopReader, Reader, ReaderThread

from .bus import Bus, bus_of
from .endpoint import EVENTS, new_gid
from .node import LocalNode, LocalNodeState

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Waitable, WaitSet

__all__ = ["LocalContext"]


class _LocalGraph(GraphView):
    def __init__(self, bus: Bus) -> None:
        super().__init__()
        self._bus = bus

    def nodes(self) -> list[NodeInfo]:
        with self._bus.lock:
            return list(self._bus.nodes)

    def endpoints(self) -> list[EndpointInfo]:
        with self._bus.lock:
            publishers = [publisher.info("publisher") for publisher in self._bus.publishers()]
            return publishers + [
                subscription.info("subscription") for subscription in self._bus.subscriptions()
            ]


class LocalContext(Context):
    """A participant of an in-process domain."""

    events = EVENTS

    def __init__(self, domain_id: int) -> None:
        self.domain_id = domain_id
        self.gid = new_gid()
        self._nodes: list[LocalNode] = []
        self._reader: Reader = LoopReader() if in_browser() else ReaderThread()
        self.bus = bus_of(domain_id)
        self._graph = _LocalGraph(self.bus)
        self._wait_sets: set[QueueWaitSet] = set()
        self._closed = False
        with self.bus.lock:
            self.bus.listeners.append(self._graph_changed)

    @property
    def graph(self) -> GraphView:
        return self._graph

    def _graph_changed(self) -> None:
        """Notify the graph's listeners on the reader thread."""
        self._reader.submit(self._graph.notify_changed)

    def replace_reader(self, reader: Reader) -> None:
        """Have ``reader`` do what the reader thread does, for nodes that are made from now on."""
        self._reader.close()
        self._reader = reader

    def create_node(self, name: str, namespace: str = "/", enclave: str = "/") -> LocalNode:
        core = LocalNodeState(NodeInfo(name, namespace, enclave), self.bus, self._reader)
        node = LocalNode(self, core, self._forget)
        with self.bus.lock:
            self._require_open(f"create node {name}")
            self._nodes.append(node)
            self.bus.nodes.append(core.info)
        self.bus.changed()
        return node

    def _forget(self, node: LocalNode) -> None:
        """Forget a node that was closed."""
        with self.bus.lock:
            if node not in self._nodes:
                return
            self._nodes.remove(node)
            self.bus.nodes.remove(node.info)
        self.bus.changed()

    def create_wait_set(self) -> WaitSet:
        with self.bus.lock:
            self._require_open("create a wait set")
            wait_set = QueueWaitSet(self.bus.lock, self._wait_sets.discard)
            self._wait_sets.add(wait_set)
        return wait_set

    def call_when_ready(self, entity: Waitable, call: Callable[[], None]) -> Callable[[], None]:
        return call_when_queued(self.bus.lock, entity, call)

    def call_soon(self, call: Callable[[], None]) -> None:
        self._reader.submit(call)

    def _require_open(self, what: str) -> None:
        if self._closed:
            raise WireError(f"{what}: the context is closed")

    def close(self) -> None:
        with self.bus.lock:
            if self._closed:
                return
            self._closed = True
            nodes = list(self._nodes)
        for node in nodes:
            node.close()
        for wait_set in list(self._wait_sets):
            wait_set.close()
        with self.bus.lock:
            self.bus.listeners.remove(self._graph_changed)
        self.bus.changed()
        self._graph.end_waits()
        self._reader.close()
