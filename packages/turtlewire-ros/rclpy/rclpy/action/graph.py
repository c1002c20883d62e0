"""Which actions there are. An action is known by its feedback topic."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    "NamesAndTypes",
    "get_action_client_names_and_types_by_node",
    "get_action_names_and_types",
    "get_action_server_names_and_types_by_node",
]

_FEEDBACK = "/_action/feedback"
_FEEDBACK_TYPE = "_FeedbackMessage"

NamesAndTypes = list[tuple[str, list[str]]]


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """Return all actions with the names of their types, as ``node`` knows them."""
    return _actions(node.get_topic_names_and_types())


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Actions of which a node is a client; raises ``NodeNameNonExistentError``."""
    return _actions(
        node.get_subscriber_names_and_types_by_node(remote_node_name, remote_node_namespace)
    )


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Actions that a node offers; raises ``NodeNameNonExistentError``."""
    return _actions(
        node.get_publisher_names_and_types_by_node(remote_node_name, remote_node_namespace)
    )


def _actions(topics: NamesAndTypes) -> NamesAndTypes:
    return [
        (topic.removesuffix(_FEEDBACK), [name.removesuffix(_FEEDBACK_TYPE) for name in type_names])
        for topic, type_names in topics
        if topic.endswith(_FEEDBACK) and any(name.endswith(_FEEDBACK_TYPE) for name in type_names)
    ]
