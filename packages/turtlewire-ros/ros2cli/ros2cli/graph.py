"""Queries of the verbs to the graph.

Names and types come as ``(name, [types])`` pairs, sorted by name. They are made printable here, so
that a peer whose names hold line feeds cannot forge lines of the output.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wire import names
from turtlewire.wire.base import NodeInfo

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Graph

NamesAndTypes = list[tuple[str, list[str]]]

_FEEDBACK = "/_action/feedback"
_FEEDBACK_TYPE = "_FeedbackMessage"


def topics(graph: Graph, *, hidden: bool = False) -> NamesAndTypes:
    """Return all topics."""
    return _visible(graph.topic_names_and_types().items(), hidden=hidden)


def services(graph: Graph, *, hidden: bool = False) -> NamesAndTypes:
    """Return all services."""
    return _visible(graph.service_names_and_types().items(), hidden=hidden)


def actions(graph: Graph) -> NamesAndTypes:
    """Return all actions, by their feedback topics."""
    return _actions(topics(graph, hidden=True))


def node_names(graph: Graph, *, hidden: bool = False) -> list[str]:
    """Return the full names of all nodes, sorted; nodes of one name are listed each."""
    nodes = map(_printable_node, graph.nodes())
    found = [names.fully_qualified_node_name(node.name, node.namespace) for node in nodes]
    return sorted(name for name in found if hidden or not is_hidden_node(name))


def full_node_name(name: str) -> str:
    """Return the name of a node with a slash in front."""
    return name if name.startswith("/") else f"/{name}"


def is_hidden_node(full_name: str) -> bool:
    """Return True if the last part of the name begins with an underscore."""
    return full_name.rpartition("/")[2].startswith("_")


def node_exists(graph: Graph, full_name: str) -> bool:
    """Return True if a node of the name is known."""
    return full_name in node_names(graph, hidden=True)


def require_node(graph: Graph, name: str) -> str:
    """Return the full name of a node.

    Raises:
        RuntimeError: The name is unknown.
    """
    full_name = full_node_name(name)
    if not node_exists(graph, full_name):
        near = did_you_mean(full_name, node_names(graph))
        raise RuntimeError(f"Node not found\n{near}".rstrip())
    return full_name


def endpoints_of_topic(graph: Graph, topic: str, kind: str) -> list[EndpointInfo]:
    """Return the publishers (``kind`` "publisher") or subscriptions ("subscription") of a topic."""
    return [
        endpoint
        for endpoint in _endpoints(graph)
        if endpoint.topic == topic and endpoint.kind == kind
    ]


def publishers(graph: Graph, full_name: str, *, hidden: bool = False) -> NamesAndTypes:
    """Return the topics that a node publishes."""
    return _of_node(graph, full_name, "publisher", _topic, hidden=hidden)


def subscribers(graph: Graph, full_name: str, *, hidden: bool = False) -> NamesAndTypes:
    """Return the topics that a node subscribes to."""
    return _of_node(graph, full_name, "subscription", _topic, hidden=hidden)


def service_servers(graph: Graph, full_name: str, *, hidden: bool = False) -> NamesAndTypes:
    """Return the services that a node offers: it reads the requests."""
    return _of_node(graph, full_name, "subscription", _service, hidden=hidden)


def service_clients(graph: Graph, full_name: str, *, hidden: bool = False) -> NamesAndTypes:
    """Return the services that a node may call: it writes the requests."""
    return _of_node(graph, full_name, "publisher", _service, hidden=hidden)


def action_servers(graph: Graph, full_name: str) -> NamesAndTypes:
    """Return the actions that a node offers: it publishes the feedback."""
    return _actions(publishers(graph, full_name, hidden=True))


def action_clients(graph: Graph, full_name: str) -> NamesAndTypes:
    """Return the actions that a node may start: it subscribes to the feedback."""
    return _actions(subscribers(graph, full_name, hidden=True))


def action_nodes(graph: Graph, action: str, kind: str) -> NamesAndTypes:
    """Return the servers (``kind`` "publisher") or clients ("subscription") of an action.

    Servers publish the feedback of the action, and clients subscribe to it.
    """
    found = []
    for endpoint in endpoints_of_topic(graph, f"{action}{_FEEDBACK}", kind):
        if endpoint.node is not None:
            name = names.fully_qualified_node_name(endpoint.node.name, endpoint.node.namespace)
            found.append((name, [endpoint.type_name.removesuffix(_FEEDBACK_TYPE)]))
    return sorted(found)


def _of_node(
    graph: Graph,
    full_name: str,
    kind: str,
    name_and_type: Callable[[EndpointInfo], tuple[str, str] | None],
    *,
    hidden: bool,
) -> NamesAndTypes:
    found: dict[str, set[str]] = {}
    for endpoint in _endpoints(graph):
        node = endpoint.node
        if (
            endpoint.kind != kind
            or node is None
            or names.fully_qualified_node_name(node.name, node.namespace) != full_name
        ):
            continue
        pair = name_and_type(endpoint)
        if pair is not None:
            found.setdefault(pair[0], set()).add(pair[1])
    return _visible(((name, sorted(types)) for name, types in found.items()), hidden=hidden)


def foreign_middlewares(graph: Graph, full_name: str) -> list[str]:
    """Return the middlewares of a node's servers that cannot be called from here, sorted."""
    found = {
        server.middleware
        for server in graph.foreign_servers()
        if server.node is not None
        and not server.is_rival
        and names.fully_qualified_node_name(*_printable_node(server.node)[:2]) == full_name
    }
    return sorted(found)


def _endpoints(graph: Graph) -> Iterator[EndpointInfo]:
    for endpoint in graph.endpoints():
        yield endpoint._replace(
            topic=printable(endpoint.topic),
            type_name=printable(endpoint.type_name),
            node=None if endpoint.node is None else _printable_node(endpoint.node),
        )


def _printable_node(node: NodeInfo) -> NodeInfo:
    return NodeInfo(printable(node.name), printable(node.namespace), printable(node.enclave))


def _topic(endpoint: EndpointInfo) -> tuple[str, str] | None:
    return (endpoint.topic, endpoint.type_name) if endpoint.topic.startswith("/") else None


def _service(endpoint: EndpointInfo) -> tuple[str, str] | None:
    service = names.service_of_requests(endpoint.topic)
    return None if service is None else (service, names.service_type(endpoint.type_name))


def _actions(feedback_topics: Iterable[tuple[str, list[str]]]) -> NamesAndTypes:
    return sorted(
        (name.removesuffix(_FEEDBACK), [kind.removesuffix(_FEEDBACK_TYPE) for kind in types])
        for name, types in feedback_topics
        if name.endswith(_FEEDBACK)
    )


def _visible(pairs: Iterable[tuple[str, list[str]]], *, hidden: bool) -> NamesAndTypes:
    return sorted(
        (printable(name), [printable(kind) for kind in types])
        for name, types in pairs
        if hidden or not names.is_hidden(name)
    )
