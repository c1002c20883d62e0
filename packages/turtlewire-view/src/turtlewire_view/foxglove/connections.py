"""The publishers, subscriptions and services of each node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.wire import names

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.wire.base import EndpointInfo

__all__ = ["GraphConnections", "connections_of", "difference"]

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
    return GraphConnections(*(_sorted(kind) for kind in (published, subscribed, served)))


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


def _sorted(nodes: dict[str, set[str]]) -> _Nodes:
    return {name: sorted(members) for name, members in nodes.items()}
