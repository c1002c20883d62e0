"""A node's view of the graph: other nodes, topics and services."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING

from rclpy._execution.blocking import limit_ns
from rclpy._node.checks import check_valid
from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError
from rclpy.expand_topic_name import expand_topic_name
from rclpy.impl.hints import with_hint
from rclpy.validate_full_topic_name import validate_full_topic_name
from turtlewire.wire import names

if TYPE_CHECKING:
    from rclpy._node.state import NodeState
    from rclpy.endpoint_info import EndpointTypeEnum, ServiceEndpointInfo, TopicEndpointInfo
    from turtlewire.wire.base import EndpointInfo, Graph, NodeInfo

NamesAndTypes = list[tuple[str, list[str]]]

#: ROS 2's words for the kinds of endpoints in its error messages.
_WORDS = {
    "publisher": "publisher",
    "subscription": "subscriber",
    "service": "service",
    "client": "client",
}
_FEEDBACK = "/_action/feedback"
_FEEDBACK_TYPE = "_FeedbackMessage"


def actions_among(topics: NamesAndTypes) -> NamesAndTypes:
    """Return the actions, with their types, whose feedback topics are among some topics."""
    return [
        (topic.removesuffix(_FEEDBACK), [name.removesuffix(_FEEDBACK_TYPE) for name in type_names])
        for topic, type_names in topics
        if topic.endswith(_FEEDBACK) and any(name.endswith(_FEEDBACK_TYPE) for name in type_names)
    ]


class NodeGraph:
    """The graph queries of one node."""

    def __init__(self, core: NodeState) -> None:
        self._core = core

    def _graph(self, failure: str) -> Graph:
        """Return the graph; an RCLError with ROS 2's words for ``failure`` if its context ended."""
        _ = self._core.wire  # raises if the node was destroyed
        check_valid(self._core.context, failure)
        return self._core.context.wire.graph

    def topic_names_and_types(self, no_demangle: bool) -> NamesAndTypes:
        graph = self._graph("failed to get topic names and types")
        return list(graph.topic_names_and_types(demangle=not no_demangle).items())

    def service_names_and_types(self) -> NamesAndTypes:
        graph = self._graph("failed to get service names and types")
        return list(graph.service_names_and_types().items())

    def node_names(self) -> list[tuple[str, str, str]]:
        """Name, namespace and enclave of all nodes."""
        return [tuple(node) for node in self._nodes()]  # type: ignore[misc]

    def _nodes(self) -> Iterable[NodeInfo]:
        return self._graph("Failed to get node names").nodes()

    def by_node(
        self, kind: str, node_name: str, node_namespace: str, *, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Topics that a node publishes (``kind`` "publisher") or subscribes to ("subscription").

        Raises:
            NodeNameNonExistentError: No node of that name is known.
        """

        def name_and_type(endpoint: EndpointInfo) -> tuple[str, str] | None:
            if no_demangle:
                # Only ROS names begin with a slash; other DDS topics have no prefix to put back.
                topic = (
                    names.topic_to_dds(endpoint.topic)
                    if endpoint.topic.startswith("/")
                    else endpoint.topic
                )
                return topic, names.type_to_dds(endpoint.type_name)
            # Other DDS topics, service topics included, have no ROS name.
            return (endpoint.topic, endpoint.type_name) if endpoint.topic.startswith("/") else None

        return self._of_node(kind, kind, node_name, node_namespace, name_and_type)

    def services_by_node(self, kind: str, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the services that a node offers (``kind`` "service") or calls ("client").

        Raises:
            NodeNameNonExistentError: No node of that name is known.
        """

        def name_and_type(endpoint: EndpointInfo) -> tuple[str, str] | None:
            service = names.service_of_requests(endpoint.topic)
            return None if service is None else (service, names.service_type(endpoint.type_name))

        # a server is known by the requests it reads, a client by those it writes
        return self._of_node(
            kind,
            "subscription" if kind == "service" else "publisher",
            node_name,
            node_namespace,
            name_and_type,
        )

    def _of_node(
        self,
        kind: str,
        end: str,
        node_name: str,
        node_namespace: str,
        name_and_type: Callable[[EndpointInfo], tuple[str, str] | None],
    ) -> NamesAndTypes:
        """Return what a node has of a ``kind``; ``end`` is the kind of endpoint on the wire."""
        word = _WORDS[kind]
        graph = self._graph(f"failed to get {word} names and types")
        if not any(
            (node.name, node.namespace) == (node_name, node_namespace) for node in graph.nodes()
        ):
            error = NodeNameNonExistentError(
                f"cannot get {word} names and types for nonexistent node: error not set"
            )
            fqn = names.fully_qualified_node_name(node_name, node_namespace)
            raise with_hint(error, f"No node {fqn} is known")
        found: dict[str, set[str]] = {}
        for endpoint in graph.endpoints():
            owner = endpoint.node
            if (
                endpoint.kind != end
                or owner is None
                or (owner.name, owner.namespace) != (node_name, node_namespace)
            ):
                continue
            pair = name_and_type(endpoint)
            if pair is not None:
                found.setdefault(pair[0], set()).add(pair[1])
        return [(name, sorted(found[name])) for name in sorted(found)]

    def count_topic(self, kind: str, topic: str) -> int:
        """Return the number of publishers or subscriptions of a topic.

        Raises:
            ValueError: The name breaks the rules.
        """
        name = self._full_name(topic)
        graph = self._graph(f"Error in rcl_count_{_WORDS[kind]}s")
        return len(graph.endpoints_of(name, kind))

    def count_service(self, kind: str, service: str) -> int:
        """Return the number of a service's servers (``kind`` "service") or clients ("client").

        Raises:
            ValueError: The name breaks the rules.
        """
        name = self._full_name(service)
        end = "subscription" if kind == "service" else "publisher"
        graph = self._graph(f"Error in rcl_count_{kind}s")
        return len(graph.endpoints_of(names.request_topic(name), end))

    def _full_name(self, name: str) -> str:
        expanded = expand_topic_name(name, self._core.name, self._core.namespace)
        validate_full_topic_name(expanded)
        return expanded

    def endpoint_infos(self, kind: str, topic: str, *, no_mangle: bool) -> list[TopicEndpointInfo]:
        """Return information about each publisher or subscription of a topic.

        Raises:
            ValueError: The name breaks the rules.
        """
        from rclpy.endpoint_info import TopicEndpointInfo

        if no_mangle:
            name = names.topic_from_dds(topic) or topic
            if name == topic and topic.startswith("/"):
                return []  # a ROS name, where the name on the wire is asked for
        else:
            name = self._full_name(topic)
        graph = self._graph(f"Failed to get information by topic for {kind}s")
        return [
            TopicEndpointInfo.from_wire(endpoint) for endpoint in graph.endpoints_of(name, kind)
        ]

    def service_infos(
        self, kind: EndpointTypeEnum, service: str, *, no_mangle: bool
    ) -> list[ServiceEndpointInfo]:
        """Return information about each client or server of a service.

        Raises:
            ValueError: The name breaks the rules.
            RCLError: ``no_mangle`` was given: on DDS, a service has no single name.
        """
        from rclpy.endpoint_info import service_infos

        if no_mangle:
            raise with_hint(
                RCLError("Failed to get information of service: no_mangle is not supported"),
                f"A service has two topics: ask for '{service}' without no_mangle, or for "
                f"'{names.request_topic(service)}' by get_publishers_info_by_topic",
            )
        core = self._core
        name = core.arguments.remap_service(self._full_name(service), core.name, core.namespace)
        return service_infos(self._graph("Failed to get information of service"), name, kind)

    def has_node(self, fully_qualified_node_name: str) -> bool:
        """Return True if a node is known; a slash before its name may be missing."""
        wanted = f"/{fully_qualified_node_name.removeprefix('/')}"
        return any(
            names.fully_qualified_node_name(node.name, node.namespace) == wanted
            for node in self._nodes()
        )

    def wait_for_node(self, fully_qualified_node_name: str, timeout_sec: float) -> bool:
        is_there = partial(self.has_node, fully_qualified_node_name)
        return self._core.context.wait_for_graph(is_there, limit_ns(timeout_sec))
