"""Selects the nodes and topics that a picture shows."""

from __future__ import annotations

import re
from typing import NamedTuple

from turtlewire.wire.names import is_hidden
from turtlewire_view.graph.picture import Mismatch, Picture

__all__ = ["TOPICS", "Selection", "select"]

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
        return not any(word in name for word in unwanted) and (
            selection.debug or not _is_of_debugging(name)
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
        _mismatches(picture, nodes, topics),
    )


def _mismatches(picture: Picture, nodes: dict[str, int], topics: set[str]) -> list[Mismatch]:
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


def _is_of_debugging(name: str) -> bool:
    return name in _DEBUG_TOPICS or is_hidden(name) or _DEBUG_NODE.match(name) is not None
