"""The methods of a node that show the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy._node.graph import actions_among
from turtlewire.wire import names

if TYPE_CHECKING:
    from rclpy._node.graph import NodeGraph
    from rclpy.endpoint_info import ServiceEndpointInfo, TopicEndpointInfo


class GraphMethods:
    """The part of :class:`~rclpy._node.base.BaseNode` that shows nodes and endpoints."""

    _rclpy_graph: NodeGraph

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[tuple[str, list[str]]]:
        """Return all topics with the names of their types."""
        return self._rclpy_graph.topic_names_and_types(no_demangle)

    def get_action_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all actions with the names of their types."""
        return actions_among(self.get_topic_names_and_types())

    def get_action_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the actions of which a node is a client; raise `NodeNameNonExistentError`."""
        return actions_among(self.get_subscriber_names_and_types_by_node(node_name, node_namespace))

    def get_action_server_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the actions that a node offers; raise `NodeNameNonExistentError`."""
        return actions_among(self.get_publisher_names_and_types_by_node(node_name, node_namespace))

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all services with the names of their types."""
        return self._rclpy_graph.service_names_and_types()

    def get_node_names(self) -> list[str]:
        """Return the base names of all nodes."""
        return [name for name, _, _ in self._rclpy_graph.node_names()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the fully qualified names of all nodes."""
        return [
            names.fully_qualified_node_name(name, namespace)
            for name, namespace, _ in self._rclpy_graph.node_names()
        ]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return name and namespace of all nodes."""
        return [(name, namespace) for name, namespace, _ in self._rclpy_graph.node_names()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return name, namespace and security enclave of all nodes."""
        return self._rclpy_graph.node_names()

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> list[tuple[str, list[str]]]:
        """Return the topics that a node publishes; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.by_node(
            "publisher", node_name, node_namespace, no_demangle=no_demangle
        )

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> list[tuple[str, list[str]]]:
        """Return the topics that a node subscribes to; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.by_node(
            "subscription", node_name, node_namespace, no_demangle=no_demangle
        )

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the services that a node offers; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.services_by_node("service", node_name, node_namespace)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the services that a node calls; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.services_by_node("client", node_name, node_namespace)

    def count_publishers(self, topic_name: str) -> int:
        """Return the number of a topic's publishers; raise ValueError for an invalid name."""
        return self._rclpy_graph.count_topic("publisher", topic_name)

    def count_subscribers(self, topic_name: str) -> int:
        """Return the number of subscriptions of a topic."""
        return self._rclpy_graph.count_topic("subscription", topic_name)

    def count_clients(self, service_name: str) -> int:
        """Return the number of clients of a service."""
        return self._rclpy_graph.count_service("client", service_name)

    def count_services(self, service_name: str) -> int:
        """Return the number of servers of a service."""
        return self._rclpy_graph.count_service("service", service_name)

    def get_publishers_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return information about each publisher of a topic."""
        return self._rclpy_graph.endpoint_infos("publisher", topic_name, no_mangle=no_mangle)

    def get_subscriptions_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return information about each subscription of a topic."""
        return self._rclpy_graph.endpoint_infos("subscription", topic_name, no_mangle=no_mangle)

    def get_clients_info_by_service(
        self, service_name: str, no_mangle: bool = False
    ) -> list[ServiceEndpointInfo]:
        """Return information about each client of a service.

        Raises:
            ValueError: The name breaks the rules.
            RCLError: ``no_mangle`` is True.
        """
        from rclpy.endpoint_info import EndpointTypeEnum

        kind = EndpointTypeEnum.CLIENT
        return self._rclpy_graph.service_infos(kind, service_name, no_mangle=no_mangle)

    def get_servers_info_by_service(
        self, service_name: str, no_mangle: bool = False
    ) -> list[ServiceEndpointInfo]:
        """Return information about each server of a service.

        Raises:
            ValueError: The name breaks the rules.
            RCLError: ``no_mangle`` is True.
        """
        from rclpy.endpoint_info import EndpointTypeEnum

        kind = EndpointTypeEnum.SERVER
        return self._rclpy_graph.service_infos(kind, service_name, no_mangle=no_mangle)
