"""One participant of a domain, with its reader thread, its nodes and its graph."""

from __future__ import annotations

import atexit
import itertools
import os
import threading
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import Context

from .announcer import Announcer, NodeRecord
from .graph import CycloneGraph
from .node import CycloneNode
from .participant import Participant
from .reader import ReaderThread
from .waiting import CycloneWaitSet

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import WaitSet

__all__ = ["CycloneContext"]


class CycloneContext(Context):
    """A participant of a Cyclone DDS domain."""

    def __init__(self, domain_id: int) -> None:
        self.domain_id = domain_id
        self._enclave = "/"
        self.participant = Participant(domain_id, self._enclave)
        self.gid = self.participant.gid
        self.reader = ReaderThread(self.participant.handle)
        self.announcer = Announcer(self.participant, self.reader)
        self._lock = threading.Lock()
        self._process = os.getpid()
        self._closed = False
        self._graph: CycloneGraph | None = None
        self._nodes: dict[CycloneNode, None] = {}
        self._wait_sets: set[CycloneWaitSet] = set()
        self._service_numbers = itertools.count(1)
        atexit.register(self.close)

    @property
    def graph(self) -> CycloneGraph:
        """See :attr:`Context.graph`."""
        with self._lock:
            if self._graph is None:
                self._require_open("look at the graph")
                self._graph = CycloneGraph(self.participant, self.announcer, self.reader)
            return self._graph

    @property
    def closing(self) -> bool:
        """Whether :meth:`close` was called."""
        return self._closed

    def graph_changed(self) -> None:
        """On the reader thread: something that a graph predicate may ask is another one now."""
        if self._graph is not None:
            self._graph.notify_changed()

    def create_node(self, name: str, namespace: str = "/", enclave: str = "/") -> CycloneNode:
        """See :meth:`Context.create_node`."""
        with self._lock:
            self._require_open(f"create node {name}")
            if enclave != self._enclave:
                self.participant.set_enclave(enclave)
                self._enclave = enclave
            node = CycloneNode(self, name, namespace)
            self._nodes[node] = None
        if self._graph is not None:
            self._graph.compare_name(names.fully_qualified_node_name(name, namespace))
        self.graph_changed()
        return node

    def remove_node(self, node: CycloneNode, record: NodeRecord) -> None:
        """Forget a node that was closed."""
        with self._lock:
            if node not in self._nodes:
                return
            del self._nodes[node]
        self.announcer.remove(record)
        self.graph_changed()

    def next_service_number(self) -> int:
        """Numbers the clients and services of this participant."""
        return next(self._service_numbers)

    def create_wait_set(self) -> WaitSet:
        """See :meth:`Context.create_wait_set`."""
        with self._lock:
            self._require_open("create a wait set")
            wait_set = CycloneWaitSet(self.participant.handle, self._wait_sets.discard)
            self._wait_sets.add(wait_set)
        return wait_set

    def call_soon(self, call: Callable[[], None]) -> None:
        """See :meth:`Context.call_soon`."""
        self.reader.call_soon(call)

    def _require_open(self, what: str) -> None:
        if self._closed:
            raise WireError(f"{what}: the context is closed")
        if self._process != os.getpid():
            error = WireError(f"{what}: the context was opened before this process was forked")
            raise error.with_hint(
                "Start processes with subprocess or multiprocessing's 'spawn', or fork before the "
                "first context."
            )

    def close(self) -> None:
        """See :meth:`Context.close`."""
        with self._lock:
            if self._closed or self._process != os.getpid():
                return
            self._closed = True
            nodes = list(self._nodes)
        atexit.unregister(self.close)
        self.reader.close()
        for node in nodes:
            node.close()
        for wait_set in list(self._wait_sets):
            wait_set.close()
        if self._graph is not None:
            self._graph.end_waits()
        self.participant.close()
