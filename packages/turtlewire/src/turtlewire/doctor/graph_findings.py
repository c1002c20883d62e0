"""Problems of nodes and topics."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING

from turtlewire.doctor.fast_dds_findings import fast_dds_findings
from turtlewire.doctor.finding import Finding, note, problem
from turtlewire.doctor.network import named_domains, other_domains
from turtlewire.doctor.setup_findings import looks_for_others, only_this_host
from turtlewire.wire.conflicts import obstacles
from turtlewire.wire.environment import Range, discovery, domain_id
from turtlewire.wire.names import fully_qualified_node_name, is_hidden
from turtlewire.wire.services import ONE_MIDDLEWARE, advice
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, ForeignServer, Graph

_RENAME = "Rename all but one: --ros-args -r __node:=NAME"
_ONE_TYPE = "Messages pass only between endpoints of one type: remap one of the topics."
_ONE_QOS = "Give both the same QoS profile, or the subscription the weaker one."

_RANGE_OFF = "The discovery range is OFF: no nodes of other processes are found."
_WIDEN_RANGE = "For nodes on this host, unset ROS_AUTOMATIC_DISCOVERY_RANGE; on others, set SUBNET."


def graph_findings(graph: Graph, *, explained: bool = False) -> list[Finding]:
    """Return the problems of the nodes and topics of a graph.

    Args:
        graph: The graph.
        explained: Whether another finding says why there may be no nodes.
    """
    names = [fully_qualified_node_name(node.name, node.namespace) for node in graph.nodes()]
    visible = [name for name in names if not is_hidden(name)]
    if not visible:
        return [] if explained else [_no_nodes()]
    found = [
        problem(f"{count} nodes have the same name {name}.", _RENAME)
        for name, count in sorted(Counter(visible).items())
        if count > 1
    ]
    topics: dict[str, list[EndpointInfo]] = {}
    for endpoint in graph.endpoints():
        if endpoint.topic.startswith("/"):
            topics.setdefault(endpoint.topic, []).append(endpoint)
    for topic, endpoints in sorted(topics.items()):
        found += _topic_findings(topic, endpoints)
    return found + _foreign_findings(graph) + fast_dds_findings(graph, topics)


def _foreign_findings(graph: Graph) -> list[Finding]:
    """Return one note for each middleware, and for each service of two, that cannot be called."""
    servers: dict[str, list[ForeignServer]] = {}
    rivals: dict[str, list[ForeignServer]] = {}
    for server in graph.foreign_servers():
        if server.is_rival:
            rivals.setdefault(server.service, []).append(server)
        else:
            servers.setdefault(server.middleware, []).append(server)
    found = []
    for middleware, theirs in sorted(servers.items()):
        text = (
            f"{counted(len(theirs), 'service')} of nodes on {middleware} cannot be called from "
            f"here, including parameters and actions; topics work. Nodes: {_owners_of(theirs)}."
        )
        found.append(note(text, advice("nodes")))
    for service, theirs in sorted(rivals.items()):
        middlewares = " and ".join(sorted({server.middleware for server in theirs}))
        text = (
            f"Service {service} cannot be called from here: it has servers on {middlewares}. "
            f"Nodes: {_owners_of(theirs)}."
        )
        found.append(note(text, ONE_MIDDLEWARE))
    return found


def _owners_of(servers: Iterable[ForeignServer]) -> str:
    return ", ".join(sorted({owner_of(server) for server in servers}))


def owner_of(endpoint: EndpointInfo | ForeignServer) -> str:
    """Return the full name of the node that owns an endpoint."""
    if endpoint.node is None:
        return "an unknown node"
    return fully_qualified_node_name(endpoint.node.name, endpoint.node.namespace)


def _no_nodes() -> Finding:
    if discovery().range == Range.OFF:
        return note(_RANGE_OFF, _WIDEN_RANGE)
    domain = os.environ.get("ROS_DOMAIN_ID") or "0"
    reach = "this host" if only_this_host() else "this network"
    remedy = ["Start a node."]
    others = other_domains(domain_id())
    if others:
        remedy.append(
            f"This host has nodes in {named_domains(others)}: "
            f"export ROS_DOMAIN_ID={others[0]} to see them."
        )
    remedy.append(
        f"Nodes that talk to each other need the same ROS_DOMAIN_ID (here {domain}); "
        f"{_for_other_hosts()}."
    )
    text = f"No nodes found in domain {domain} on {reach}."
    # On this host alone, for example after the installation, nothing needs to run yet.
    return (problem if looks_for_others() else note)(text, " ".join(remedy))


def _for_other_hosts() -> str:
    if looks_for_others():
        return (
            "nodes on other hosts are found if their discovery range is SUBNET, too, or if one "
            "side names the other in ROS_STATIC_PEERS"
        )
    return (
        "for nodes on other hosts, set ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET on both sides "
        f"(here {discovery().range.value})"
    )


def _topic_findings(topic: str, endpoints: list[EndpointInfo]) -> list[Finding]:
    types = sorted({endpoint.type_name for endpoint in endpoints})
    if len(types) > 1:
        text = f"{topic} has endpoints of different types: {', '.join(types)}."
        return [problem(text, _ONE_TYPE)]
    found = []
    for publisher in (end for end in endpoints if end.kind == "publisher"):
        for subscription in (end for end in endpoints if end.kind == "subscription"):
            for obstacle in obstacles(publisher, subscription)[:1]:
                receiver, sender = owner_of(subscription), owner_of(publisher)
                text = f"{topic}: {receiver} receives nothing from {sender}: {obstacle.reason}."
                found.append(problem(text, _ONE_QOS))
    return found
