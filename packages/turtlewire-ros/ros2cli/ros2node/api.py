"""Nodes of the graph and what they have, completions."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any, NamedTuple

from ros2cli import graph
from ros2cli.node import HIDDEN_NODE_PREFIX
from ros2cli.node.direct import DirectNode
from ros2node.verb.info import INFO_NONUNIQUE_WARNING_TEMPLATE

if TYPE_CHECKING:
    from ros2cli.graph import NamesAndTypes

__all__ = [
    "HIDDEN_NODE_PREFIX",
    "INFO_NONUNIQUE_WARNING_TEMPLATE",
    "NodeName",
    "NodeNameCompleter",
    "TopicInfo",
    "get_absolute_node_name",
    "get_action_client_info",
    "get_action_server_info",
    "get_node_names",
    "get_publisher_info",
    "get_service_client_info",
    "get_service_server_info",
    "get_subscriber_info",
    "get_topics",
    "has_duplicates",
    "parse_node_name",
    "wait_for_node",
]


class NodeName(NamedTuple):
    """Name of a node, its namespace, and both together."""

    name: str
    namespace: str
    full_name: str


class TopicInfo(NamedTuple):
    """Name of a topic, service or action, and its types."""

    name: str
    types: list[str]


def get_absolute_node_name(node_name: str) -> str | None:
    """Return the name with a slash in front; None for an empty name."""
    return graph.full_node_name(node_name) if node_name else None


def parse_node_name(node_name: str) -> NodeName:
    """Return name and namespace of a full name; ``turtlesim`` means ``/turtlesim``."""
    full_name = graph.full_node_name(node_name)
    namespace, _, name = full_name.rpartition("/")
    return NodeName(name, namespace or "/", full_name)


def has_duplicates(values: Collection[Any]) -> bool:
    """Return True if a value occurs twice."""
    return len(set(values)) < len(values)


def get_node_names(*, node: Any, include_hidden_nodes: bool = False) -> list[NodeName]:
    """Return the names of the nodes that a node sees, itself included."""
    names = [
        NodeName(name, namespace, f"{namespace.rstrip('/')}/{name}")
        for name, namespace in node.get_node_names_and_namespaces()
    ]
    return [each for each in names if include_hidden_nodes or not graph.is_hidden_node(each.name)]


def wait_for_node(
    node: Any, node_name: str, include_hidden_nodes: bool = False, timeout: float = 1.0
) -> bool:
    """Wait until a node exists.

    Args:
        node: The node that looks.
        node_name: Full name of the other node.
        include_hidden_nodes: Whether a hidden node counts.
        timeout: Seconds to wait.

    Returns:
        Whether the node exists.
    """
    full_name = graph.full_node_name(node_name)
    direct = DirectNode.around(node)

    def is_there() -> bool:
        return full_name in graph.node_names(direct.graph, hidden=include_hidden_nodes)

    return direct.wait_for(is_there, timeout)


def get_topics(
    remote_node_name: str,
    func: Callable[[str, str], NamesAndTypes],
    *,
    include_hidden_topics: bool = False,
) -> list[TopicInfo]:
    """Call a function with a node's name and namespace.

    Args:
        remote_node_name: Full name of the node.
        func: For example ``node.get_publisher_names_and_types_by_node``.
        include_hidden_topics: Whether to list names with a part that begins with an underscore.
    """
    from turtlewire.wire.names import is_hidden

    parsed = parse_node_name(remote_node_name)
    return [
        TopicInfo(name, list(types))
        for name, types in func(parsed.name, parsed.namespace)
        if include_hidden_topics or not is_hidden(name)
    ]


def get_subscriber_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the topics to which a node subscribes."""
    return _info(node.get_subscriber_names_and_types_by_node, remote_node_name, include_hidden)


def get_publisher_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the topics that a node publishes."""
    return _info(node.get_publisher_names_and_types_by_node, remote_node_name, include_hidden)


def get_service_client_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the services that a node may call."""
    return _info(node.get_client_names_and_types_by_node, remote_node_name, include_hidden)


def get_service_server_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the services that a node offers."""
    return _info(node.get_service_names_and_types_by_node, remote_node_name, include_hidden)


def get_action_server_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the actions that a node offers."""
    from rclpy.action import get_action_server_names_and_types_by_node as ask

    # ROS 2's tools pass a `DirectNode` or the like, which wraps the node that is needed here.
    real = getattr(node, "node", node)
    return _info(
        lambda name, namespace: ask(real, name, namespace), remote_node_name, include_hidden
    )


def get_action_client_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the actions that a node may start."""
    from rclpy.action import get_action_client_names_and_types_by_node as ask

    real = getattr(node, "node", node)
    return _info(
        lambda name, namespace: ask(real, name, namespace), remote_node_name, include_hidden
    )


def _info(
    func: Callable[[str, str], NamesAndTypes], remote_node_name: str, hidden: bool
) -> list[TopicInfo]:
    return get_topics(remote_node_name, func, include_hidden_topics=hidden)


class NodeNameCompleter:
    """Offers full names of nodes to the shell.

    Args:
        include_hidden_nodes_key: Attribute of the command line that asks for hidden nodes.
    """

    def __init__(self, *, include_hidden_nodes_key: str | None = None) -> None:
        self.include_hidden_nodes_key = include_hidden_nodes_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the full names of the nodes there are now."""
        hidden = getattr(parsed_args, self.include_hidden_nodes_key or "", False)
        with DirectNode(parsed_args) as node:
            found = get_node_names(node=node, include_hidden_nodes=hidden)
        return [each.full_name for each in found]
