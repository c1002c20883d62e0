"""One participant of a domain, with its reader thread, its nodes and its graph."""

from __future__ import annotations

import atexit
import os
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import Context, EventKind

from .graph import CycloneGraph
from .node import CycloneContextState, CycloneNode
from .waiting import CycloneWaitSet, readable_part

if TYPE_CHECKING:
    from turtlewire.wire.base import Waitable, WaitSet


class CycloneContext(Context):
    """A participant of a Cyclone DDS domain."""

    events = frozenset(EventKind)

    def __init__(self, domain_id: int, enclave: str) -> None:
        self.domain_id = domain_id
        self._core = CycloneContextState(domain_id, enclave)
        self.gid = self._core.participant.gid
        self._lock = threading.Lock()
        self._process = os.getpid()
        self._nodes: dict[CycloneNode, None] = {}
        self._wait_sets: set[CycloneWaitSet] = set()
        atexit.register(self.close)

    @property
    def graph(self) -> CycloneGraph:
        with self._lock:
            core = self._core
            if core.graph is None:
                self._require_open("look at the graph")
                core.graph = CycloneGraph(core.participant, core.announcer, core.reader)
            return core.graph

    def create_node(self, name: str, namespace: str = "/") -> CycloneNode:
        with self._lock:
            self._require_open(f"create node {name}")
            node = CycloneNode(self, self._core, name, namespace, self._forget)
            self._nodes[node] = None
        graph = self._core.graph
        if graph is not None:
            graph.compare_name(names.fully_qualified_node_name(name, namespace))
        self._core.graph_changed()
        return node

    def _forget(self, node: CycloneNode) -> None:
        """Forget a node that was closed."""
        with self._lock:
            if node not in self._nodes:
                return
            del self._nodes[node]
        self._core.announcer.remove(node.record)
        self._core.graph_changed()

    def create_wait_set(self) -> WaitSet:
        with self._lock:
            self._require_open("create a wait set")
            wait_set = CycloneWaitSet(self._core.participant.handle, self._wait_sets.discard)
            self._wait_sets.add(wait_set)
        return wait_set

    def call_when_ready(self, entity: Waitable, call: Callable[[], None]) -> Callable[[], None]:
        reader = self._core.reader
        condition = readable_part(entity).condition()

        def report() -> None:
            reader.unwatch(condition)  # it stays true until everything is taken
            call()

        reader.watch(condition, report)
        return lambda: reader.unwatch(condition)

    def call_soon(self, call: Callable[[], None]) -> None:
        self._core.reader.call_soon(call)

    def _require_open(self, what: str) -> None:
        if self._core.closing:
            raise WireError(f"{what}: the context is closed")
        if self._process != os.getpid():
            error = WireError(f"{what}: the context was opened before this process was forked")
            raise error.with_hint(
                "Start processes with subprocess or multiprocessing's 'spawn', or fork before the "
                "first context."
            )

    def close(self) -> None:
        if self._process != os.getpid():  # see `Entity.close`
            return
        with self._lock:
            if self._core.closing:
                return
            self._core.closing = True
            nodes = list(self._nodes)
        atexit.unregister(self.close)
        self._core.reader.close()
        for node in nodes:
            node.close()
        for wait_set in list(self._wait_sets):
            wait_set.close()
        if self._core.graph is not None:
            self._core.graph.end_waits()
        self._core.participant.close()
