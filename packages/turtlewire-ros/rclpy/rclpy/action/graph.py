"""The actions in the graph, as functions of a node."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

NamesAndTypes = list[tuple[str, list[str]]]


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """Return all actions with the names of their types, as ``node`` knows them."""
    return node.get_action_names_and_types()


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions of which a node is a client; raises ``NodeNameNonExistentError``."""
    return node.get_action_client_names_and_types_by_node(remote_node_name, remote_node_namespace)


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions that a node offers; raises ``NodeNameNonExistentError``."""
    return node.get_action_server_names_and_types_by_node(remote_node_name, remote_node_namespace)
