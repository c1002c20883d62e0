"""Contexts, nodes and the graph of the in-process middleware."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import (
    Client,
    Context,
    EndpointInfo,
    MessageInfo,
    Node,
    NodeInfo,
    Publisher,
    Service,
    Subscription,
)
from turtlewire.wire.graph import GraphView, with_best_available
from turtlewire.wire.services import TopicClient, TopicService

from .bus import Bus, bus_of, new_gid
from .endpoints import LocalPublisher, LocalSubscription
from .waiting import LocalWaitSet, ReaderThread

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Sink, TypeId, WaitSet
    from turtlewire.wire.qos import QoS

    from .endpoints import LocalEndpoint

__all__ = ["LocalContext", "LocalNode"]


class LocalNode(Node):
    """A node of a :class:`LocalContext`."""

    def __init__(self, context: LocalContext, name: str, namespace: str, enclave: str) -> None:
        self.context = context
        self.name = name
        self.namespace = namespace
        self.info = NodeInfo(name, namespace, enclave)
        self.endpoints: set[LocalEndpoint] = set()

    def create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        """See :meth:`Node.create_publisher`."""
        qos = with_best_available(qos, topic, "publisher", self.context)
        dds_topic = names.topic_to_dds(topic, bare=qos.avoid_ros_namespace_conventions)
        return LocalPublisher(self, topic, dds_topic, type_id, qos)

    def create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
        sink: Sink | None = None,  # noqa: ARG002 - it would gain nothing here
    ) -> Subscription:
        """See :meth:`Node.create_subscription`."""
        qos = with_best_available(qos, topic, "subscription", self.context)
        dds_topic = names.topic_to_dds(topic, bare=qos.avoid_ros_namespace_conventions)
        return LocalSubscription(self, topic, dds_topic, type_id, qos, on_message=on_message)

    def create_client(self, service: str, request: TypeId, response: TypeId, qos: QoS) -> Client:
        """See :meth:`Node.create_client`."""
        replies = LocalSubscription(self, service, names.reply_topic(service), response, qos)
        requests = LocalPublisher(self, service, names.request_topic(service), request, qos)
        return TopicClient(service, int.from_bytes(requests.gid[-8:], "big"), requests, replies)

    def create_service(self, service: str, request: TypeId, response: TypeId, qos: QoS) -> Service:
        """See :meth:`Node.create_service`."""
        requests = LocalSubscription(self, service, names.request_topic(service), request, qos)
        replies = LocalPublisher(self, service, names.reply_topic(service), response, qos)
        return TopicService(service, requests, replies)

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self.context.bus.lock:
            endpoints = list(self.endpoints)
        for endpoint in endpoints:
            endpoint.close()
        self.context.remove_node(self)


class _LocalGraph(GraphView):
    def __init__(self, bus: Bus) -> None:
        super().__init__()
        self._bus = bus

    def nodes(self) -> list[NodeInfo]:
        """See :meth:`Graph.nodes`."""
        with self._bus.lock:
            return [node.info for context in self._bus.contexts for node in context.nodes]

    def endpoints(self) -> list[EndpointInfo]:
        """See :meth:`Graph.endpoints`."""
        with self._bus.lock:
            publishers = [publisher.info("publisher") for publisher in self._bus.publishers()]
            return publishers + [
                subscription.info("subscription") for subscription in self._bus.subscriptions()
            ]


class LocalContext(Context):
    """A participant of an in-process domain."""

    def __init__(self, domain_id: int) -> None:
        self.domain_id = domain_id
        self.gid = new_gid()
        self.nodes: list[LocalNode] = []
        self.reader = ReaderThread()
        self.bus = bus_of(domain_id)
        self._graph = _LocalGraph(self.bus)
        self._wait_sets: set[LocalWaitSet] = set()
        self._closed = False
        with self.bus.lock:
            self.bus.contexts.append(self)

    @property
    def graph(self) -> GraphView:
        """See :attr:`Context.graph`."""
        return self._graph

    def graph_changed(self) -> None:
        """The graph is another one now: tell those who wait for it."""
        self.reader.submit(self._graph.notify_changed)

    def create_node(self, name: str, namespace: str = "/", enclave: str = "/") -> LocalNode:
        """See :meth:`Context.create_node`."""
        node = LocalNode(self, name, namespace, enclave)
        with self.bus.lock:
            self._require_open(f"create node {name}")
            self.nodes.append(node)
        self.bus.changed()
        return node

    def remove_node(self, node: LocalNode) -> None:
        """Forget a node that was closed."""
        with self.bus.lock:
            if node not in self.nodes:
                return
            self.nodes.remove(node)
        self.bus.changed()

    def create_wait_set(self) -> WaitSet:
        """See :meth:`Context.create_wait_set`."""
        with self.bus.lock:
            self._require_open("create a wait set")
            wait_set = LocalWaitSet(self.bus, self._wait_sets.discard)
            self._wait_sets.add(wait_set)
        return wait_set

    def call_soon(self, call: Callable[[], None]) -> None:
        """See :meth:`Context.call_soon`."""
        self.reader.submit(call)

    def _require_open(self, what: str) -> None:
        if self._closed:
            raise WireError(f"{what}: the context is closed")

    def close(self) -> None:
        """See :meth:`Context.close`."""
        with self.bus.lock:
            if self._closed:
                return
            self._closed = True
            nodes = list(self.nodes)
        for node in nodes:
            node.close()
        for wait_set in list(self._wait_sets):
            wait_set.close()
        with self.bus.lock:
            self.bus.contexts.remove(self)
        self.bus.changed()
        self._graph.end_waits()
        self.reader.close()
