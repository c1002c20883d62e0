"""The publishers, subscriptions and services of each node, and their changes, for asyncio."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.wire import names

if TYPE_CHECKING:
    from turtlewire.web.loop_calls import LoopCalls
    from turtlewire.wire.base import EndpointInfo, Graph

__all__ = ["GraphConnections", "GraphWatch", "connections_of", "difference"]

_Nodes = dict[str, list[str]]
"""Topic or service to the full names of nodes, sorted."""


class GraphConnections(NamedTuple):
    """The connections at one moment."""

    published: _Nodes
    subscribed: _Nodes
    served: _Nodes


def connections_of(endpoints: Iterable[EndpointInfo]) -> GraphConnections:
    """Return the connections that these endpoints make."""
    published: dict[str, set[str]] = {}
    subscribed: dict[str, set[str]] = {}
    served: dict[str, set[str]] = {}
    for end in endpoints:
        node = _node_of(end)
        service = names.service_of_requests(end.topic)
        if service is not None:
            if end.kind == "subscription":
                served.setdefault(service, set()).add(node)
        elif end.topic.startswith("/"):
            kind = published if end.kind == "publisher" else subscribed
            kind.setdefault(end.topic, set()).add(node)
    return GraphConnections(
        *(
            {name: sorted(nodes) for name, nodes in kind.items()}
            for kind in (published, subscribed, served)
        )
    )


def difference(before: GraphConnections, now: GraphConnections) -> dict[str, Any]:
    """Return the fields that changed since `before`."""
    topics_before = before.published.keys() | before.subscribed.keys()
    topics_now = now.published.keys() | now.subscribed.keys()
    # A topic that has lost all publishers, but not all subscriptions, must be sent as empty.
    published = {topic: now.published.get(topic, []) for topic in topics_now}
    subscribed = {topic: now.subscribed.get(topic, []) for topic in topics_now}
    return {
        "publishedTopics": _entries(before.published, published, "publisherIds"),
        "subscribedTopics": _entries(before.subscribed, subscribed, "subscriberIds"),
        "advertisedServices": _entries(before.served, now.served, "providerIds"),
        "removedTopics": sorted(topics_before - topics_now),
        "removedServices": sorted(before.served.keys() - now.served.keys()),
    }


def _entries(before: _Nodes, now: _Nodes, ids: str) -> list[dict[str, Any]]:
    return [
        {"name": name, ids: nodes}
        for name, nodes in sorted(now.items())
        if before.get(name, []) != nodes
    ]


def _node_of(end: EndpointInfo) -> str:
    if end.node is None:
        return end.gid.hex()
    return names.fully_qualified_node_name(end.node.name, end.node.namespace)


#: Changes come in groups; time to wait for further changes after the first one [s].
_REST = 0.05


class GraphWatch:
    """Calls back on the loop's thread after changes of the graph. For that thread.

    Args:
        graph: The graph.
        calls: Of the loop.
        on_change: Called once after a group of changes.
    """

    def __init__(self, graph: Graph, calls: LoopCalls, on_change: Callable[[], None]) -> None:
        self._calls = calls
        self._on_change = on_change
        self._is_told = False
        self._timer: asyncio.TimerHandle | None = None
        self._waiting: set[asyncio.Event] = set()
        self._stop_listening = graph.add_listener(self._tell)

    def _tell(self) -> None:
        """Notify the loop of a change; runs on a thread of the middleware."""
        if not self._is_told:
            self._is_told = True
            self._calls.soon(self._changed)

    def _changed(self) -> None:
        self._is_told = False
        for event in self._waiting:
            event.set()
        if self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(_REST, self._call)

    def _call(self) -> None:
        self._timer = None
        self._on_change()

    async def wait_until(self, predicate: Callable[[], bool], limit_s: float) -> bool:
        """Wait until ``predicate()`` is true, and test it after every change; its last value."""
        loop = asyncio.get_running_loop()
        end = loop.time() + limit_s
        event = asyncio.Event()
        self._waiting.add(event)
        try:
            while not predicate():
                if loop.time() >= end:
                    return False
                try:
                    await asyncio.wait_for(event.wait(), end - loop.time())
                except asyncio.TimeoutError:
                    continue  # the predicate decides
                event.clear()
        finally:
            self._waiting.discard(event)
        return True

    def close(self) -> None:
        """Stop all further calls."""
        self._stop_listening()
        if self._timer is not None:
            self._timer.cancel()
