"""The graph at one moment: nodes, topics, their endpoints, and pairs that do not connect."""

from __future__ import annotations

from collections import Counter
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.wire.matching import obstacles
from turtlewire.wire.names import fully_qualified_node_name

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.wire.base import EndpointInfo, Graph

__all__ = ["UNKNOWN", "Endpoint", "Mismatch", "Picture", "read_graph"]

#: The owner of endpoints that no node claims, such as those of DDS programs without ROS.
UNKNOWN = "(unknown node)"


class Endpoint(NamedTuple):
    """A publisher or subscription, and the full name of its node."""

    node: str
    info: EndpointInfo


class Mismatch(NamedTuple):
    """Publishers and subscriptions of a topic that the middleware does not connect.

    Attributes:
        topic: The topic.
        policy: The QoS policy that keeps them apart, or ``type``.
        reason: The reason in words; "it" is the subscription.
        publishers: The nodes of the publishers.
        subscriptions: The nodes of the subscriptions.
    """

    topic: str
    policy: str
    reason: str
    publishers: tuple[str, ...]
    subscriptions: tuple[str, ...]


class Picture(NamedTuple):
    """The nodes and topics of a domain.

    Attributes:
        domain_id: The domain.
        nodes: How many nodes have each name.
        topics: The types of each topic.
        endpoints: Publishers and subscriptions, in the order of topics and nodes.
        mismatches: What keeps endpoints apart.
    """

    domain_id: int
    nodes: dict[str, int]
    topics: dict[str, list[str]]
    endpoints: list[Endpoint]
    mismatches: list[Mismatch]


def read_graph(graph: Graph, domain_id: int, own_node: str = "") -> Picture:
    """Return what is known of the graph now, without services.

    Args:
        graph: The graph.
        domain_id: Its domain.
        own_node: The full name of a node that is left out: the one of the page.
    """
    nodes = Counter(fully_qualified_node_name(each.name, each.namespace) for each in graph.nodes())
    endpoints = sorted(
        (Endpoint(_owner(each), each) for each in graph.endpoints() if _is_of_topic(each)),
        key=lambda each: (each.info.topic, each.node, each.info.kind, each.info.gid),
    )
    nodes.pop(own_node, None)
    endpoints = [each for each in endpoints if each.node != own_node]
    for node, _ in endpoints:
        nodes.setdefault(node, 1)
    topics: dict[str, list[Endpoint]] = {}
    for endpoint in endpoints:
        topics.setdefault(endpoint.info.topic, []).append(endpoint)
    types = {
        topic: sorted({each.info.type_name for each in ends}) for topic, ends in topics.items()
    }
    mismatches = [found for topic, ends in topics.items() for found in _mismatches(topic, ends)]
    return Picture(domain_id, dict(sorted(nodes.items())), types, endpoints, mismatches)


def _is_of_topic(endpoint: EndpointInfo) -> bool:
    return endpoint.topic.startswith("/") and not endpoint.qos.avoid_ros_namespace_conventions


def _owner(endpoint: EndpointInfo) -> str:
    if endpoint.node is None:
        return UNKNOWN
    return fully_qualified_node_name(endpoint.node.name, endpoint.node.namespace)


def _mismatches(topic: str, endpoints: list[Endpoint]) -> list[Mismatch]:
    """Compare each kind of publisher with each kind of subscription, and not each pair.

    Hundreds of nodes publish and subscribe to ``/tf``, mostly with equal QoS.
    """
    publishers = _kinds(each for each in endpoints if each.info.kind == "publisher")
    subscriptions = _kinds(each for each in endpoints if each.info.kind == "subscription")
    return [
        Mismatch(topic, *obstacle, _names(senders), _names(receivers))
        for senders, receivers in product(publishers, subscriptions)
        for obstacle in obstacles(senders[0].info, receivers[0].info)
    ]


def _kinds(endpoints: Iterable[Endpoint]) -> list[list[Endpoint]]:
    """Return the endpoints in groups of one type and QoS."""
    groups: dict[object, list[Endpoint]] = {}
    for endpoint in endpoints:
        _, _, type_name, type_hash, _, _, qos, _ = endpoint.info
        groups.setdefault((type_name, type_hash, qos), []).append(endpoint)
    return list(groups.values())


def _names(endpoints: list[Endpoint]) -> tuple[str, ...]:
    return tuple(sorted({each.node for each in endpoints}))
