"""The graph at one moment: nodes, topics, their endpoints, mismatches; what of it is shown."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.wire.conflicts import obstacles
from turtlewire.wire.names import fully_qualified_node_name, is_hidden

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Graph

__all__ = [
    "TOPICS",
    "UNKNOWN",
    "Endpoint",
    "Mismatch",
    "Picture",
    "Selection",
    "read_graph",
    "select",
]

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


#: What `Selection.topics` may be.
TOPICS = ("all", "connected", "none")
_DEBUG_TOPICS = {"/rosout", "/parameter_events"}
#: Nodes of tools that read the graph, and helpers of another node.
_DEBUG_NODE = re.compile(
    r"/(rqt|rviz|foxglove_bridge|launch_ros_\d|turtlewire_view_\d|transform_listener_impl_)"
)


class Selection(NamedTuple):
    """The parts of a graph that are shown.

    Attributes:
        topics: ``all``, ``connected`` (only those with a publisher and a subscription), or
            ``none``: arrows lead from node to node.
        debug: True includes ``/rosout``, ``/parameter_events``, names with a token that begins
            with an underscore, and the nodes of tools.
        words: Parts of names. A topic or node is shown with its neighbours if its name contains
            one of them; a word that begins with ``-`` removes those whose name contains the rest.
    """

    topics: str = "all"
    debug: bool = False
    words: str = ""


def select(picture: Picture, selection: Selection) -> Picture:
    """Return the part of a picture that is shown."""
    wanted, unwanted = _words(selection.words)

    def may_be_shown(name: str) -> bool:
        is_of_debugging = name in _DEBUG_TOPICS or is_hidden(name) or _DEBUG_NODE.match(name)
        return not any(word in name for word in unwanted) and (
            selection.debug or not is_of_debugging
        )

    def is_found(name: str) -> bool:
        return not wanted or any(word in name for word in wanted)

    endpoints = [
        each
        for each in picture.endpoints
        if may_be_shown(each.node)
        and may_be_shown(each.info.topic)
        and (is_found(each.node) or is_found(each.info.topic))
    ]
    if selection.topics == "connected":
        kinds = {(each.info.topic, each.info.kind) for each in endpoints}
        sent, received = (
            {topic for topic, of in kinds if of == kind} for kind in ("publisher", "subscription")
        )
        endpoints = [each for each in endpoints if each.info.topic in sent & received]
    owners, topics = {each.node for each in endpoints}, {each.info.topic for each in endpoints}
    nodes = {
        name: count
        for name, count in picture.nodes.items()
        if name in owners or (may_be_shown(name) and is_found(name))
    }
    return Picture(
        picture.domain_id,
        nodes,
        {name: types for name, types in picture.topics.items() if name in topics},
        endpoints,
        _shown_mismatches(picture, nodes, topics),
    )


def _shown_mismatches(picture: Picture, nodes: dict[str, int], topics: set[str]) -> list[Mismatch]:
    """Return the mismatches between nodes that are shown."""
    found = []
    for each in picture.mismatches:
        publishers, subscriptions = (
            tuple(name for name in names if name in nodes)
            for names in (each.publishers, each.subscriptions)
        )
        if each.topic in topics and publishers and subscriptions:
            found.append(each._replace(publishers=publishers, subscriptions=subscriptions))
    return found


def _words(text: str) -> tuple[list[str], list[str]]:
    words = text.split()
    unwanted = [word[1:] for word in words if word.startswith("-")]
    return [word for word in words if not word.startswith("-")], [each for each in unwanted if each]
