"""Contexts of the in-process middleware, their nodes, publishers and subscriptions; the graph."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.platforms import in_browser
from turtlewire.wire import names
from turtlewire.wire.base import (
    Context,
    EndpointInfo,
    MessageInfo,
    NodeInfo,
    Publisher,
    Subscription,
)
from turtlewire.wire.checked_node import CheckedNode
from turtlewire.wire.encapsulation import joined, require_message
from turtlewire.wire.graph import GraphView, with_best_available
from turtlewire.wire.qos import Durability
from turtlewire.wire.queue_wait_set import Queued, QueueWaitSet, call_when_queued
from turtlewire.wire.reader_thread import LoopReader, Reader, ReaderThread, deliver
from turtlewire.wire.services import TopicClient, TopicService

from .bus import EVENTS, Bus, LocalEndpoint, LocalEndpointSpec, Message, bus_of, new_gid

if TYPE_CHECKING:
    from turtlewire.wire.base import Client, Service, ServiceTypes, Sink, TypeId, Waitable, WaitSet
    from turtlewire.wire.encapsulation import Cdr
    from turtlewire.wire.qos import QoS
    from turtlewire.wire.queue_wait_set import Watcher


class LocalNodeState:
    """The bus that a node's endpoints are on and the thread that calls their callbacks.

    Attributes:
        endpoints: The node's open endpoints, guarded by the bus's lock.
    """

    def __init__(self, info: NodeInfo, bus: Bus, reader: Reader) -> None:
        self.info = info
        self.bus = bus
        self.reader = reader
        self.endpoints: set[LocalEndpoint] = set()


class LocalPublisher(LocalEndpoint, Publisher):
    """Hands its messages to the queues of the matching subscriptions."""

    def __init__(self, node: LocalNodeState, spec: LocalEndpointSpec) -> None:
        super().__init__(spec, node.info, node.bus.lock)
        self._core = node
        self._published = 0
        with self._lock:
            node.bus.add_publisher(self)
            node.endpoints.add(self)
        node.bus.changed()

    def publish(self, cdr: Cdr) -> None:
        cdr = joined(cdr)
        require_message(cdr, self.topic)
        now = time.time_ns()
        with self._lock:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            self._published += 1
            message = (cdr, MessageInfo(now, now, self.gid, self._published))
            if self._core.bus.tamper is None:
                self.deliver(message)
            else:
                self._core.bus.tamper(self, message)

    def deliver(self, message: Message) -> None:
        """Hand a message to the matching subscriptions; nothing happens after the end."""
        with self._lock:
            if self._closed:
                return
            if self.qos.durability == Durability.TRANSIENT_LOCAL:
                self._queue.append(message)
            for subscription in self.matched:
                subscription.receive(message)

    def kept(self) -> list[Message]:
        oldest = time.time_ns() - self.qos.lifespan_ns if self.qos.lifespan_ns else 0
        return [message for message in self._queue if message[1].source_timestamp_ns >= oldest]

    def subscription_count(self) -> int:
        return len(self.matched)

    def assert_liveliness(self) -> None:
        """Do nothing: publishers of one process end together."""

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:  # noqa: ARG002 - see below
        """Return True: messages arrive as they are published."""
        return True

    def _leave(self) -> None:
        self._core.endpoints.discard(self)
        self._core.bus.remove_publisher(self)
        self._core.bus.changed()


class LocalSubscription(LocalEndpoint, Queued, Subscription):
    """Keeps messages until they are taken.

    Attributes:
        watchers: What waits for it, and what to call when a message arrives.
    """

    def __init__(
        self,
        node: LocalNodeState,
        spec: LocalEndpointSpec,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
    ) -> None:
        super().__init__(spec, node.info, node.bus.lock)
        self._core = node
        self._on_message = on_message
        self.watchers: dict[Watcher, Callable[[], None]] = {}
        with self._lock:
            node.bus.add_subscription(self)
            node.endpoints.add(self)
        node.bus.changed()

    def meet(self, other: LocalEndpoint) -> None:
        super().meet(other)
        if self.qos.durability == Durability.TRANSIENT_LOCAL:
            for message in other.kept():
                self.receive(message)

    def receive(self, message: Message) -> None:
        self._queue.append(message)
        if self._on_message is not None:
            self._core.reader.submit(self._deliver)
        self.tell_watchers()

    def _deliver(self) -> None:
        """Hand over all waiting messages; on the reader thread."""
        assert self._on_message is not None
        deliver(self.take(limit=len(self._queue)), self._on_message, lambda: self._closed)

    def publisher_count(self) -> int:
        return len(self.matched)

    def _leave(self) -> None:
        self._core.endpoints.discard(self)
        self._core.bus.remove_subscription(self)
        self._core.bus.changed()
        self.leave_watchers()


class LocalNode(CheckedNode):
    """A node of a context.

    Args:
        context: The context that makes it.
        core: What its endpoints are given.
        on_closed: Called when it is closed.
    """

    def __init__(
        self, context: Context, core: LocalNodeState, on_closed: Callable[[LocalNode], None]
    ) -> None:
        super().__init__()
        self.context = context
        self.info = core.info
        self.name = core.info.name
        self.namespace = core.info.namespace
        self._core = core
        self._on_closed = on_closed

    def _create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        qos = with_best_available(qos, topic, "publisher", self.context)
        dds_topic = names.topic_to_dds(topic, bare=qos.avoid_ros_namespace_conventions)
        return LocalPublisher(self._core, LocalEndpointSpec(topic, dds_topic, type_id, qos))

    def _create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None,
        sink: Sink | None,  # noqa: ARG002 - it would gain nothing here
    ) -> Subscription:
        qos = with_best_available(qos, topic, "subscription", self.context)
        dds_topic = names.topic_to_dds(topic, bare=qos.avoid_ros_namespace_conventions)
        spec = LocalEndpointSpec(topic, dds_topic, type_id, qos)
        return LocalSubscription(self._core, spec, on_message)

    def _create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        requests_, replies_ = _specs(service, types, qos)
        replies = LocalSubscription(self._core, replies_)
        requests = LocalPublisher(self._core, requests_)
        return TopicClient(service, int.from_bytes(requests.gid[-8:], "big"), requests, replies)

    def _create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        requests_, replies_ = _specs(service, types, qos)
        requests = LocalSubscription(self._core, requests_)
        replies = LocalPublisher(self._core, replies_)
        return TopicService(service, requests, replies)

    def _close(self) -> None:
        with self._core.bus.lock:
            endpoints = list(self._core.endpoints)
        for endpoint in endpoints:
            endpoint.close()
        self._on_closed(self)


def _specs(
    service: str, types: ServiceTypes, qos: QoS
) -> tuple[LocalEndpointSpec, LocalEndpointSpec]:
    """Return the specs of a service's requests and replies."""
    topics = (
        (names.request_topic(service), types.request),
        (names.reply_topic(service), types.response),
    )
    service_hash = types.announced_hash()
    requests, replies = (
        LocalEndpointSpec(service, topic, type_id, qos, service_hash) for topic, type_id in topics
    )
    return requests, replies


class _LocalGraph(GraphView):
    def __init__(self, bus: Bus) -> None:
        super().__init__()
        self._bus = bus

    def nodes(self) -> list[NodeInfo]:
        with self._bus.lock:
            return list(self._bus.nodes)

    def endpoints(self) -> list[EndpointInfo]:
        with self._bus.lock:
            publishers = [publisher.info("publisher") for publisher in self._bus.publishers()]
            return publishers + [
                subscription.info("subscription") for subscription in self._bus.subscriptions()
            ]


class LocalContext(Context):
    """A participant of an in-process domain."""

    events = EVENTS

    def __init__(self, domain_id: int, enclave: str) -> None:
        self.domain_id = domain_id
        self._enclave = enclave
        self.gid = new_gid()
        self._nodes: list[LocalNode] = []
        self._reader: Reader = LoopReader() if in_browser() else ReaderThread()
        self.bus = bus_of(domain_id)
        self._graph = _LocalGraph(self.bus)
        self._wait_sets: set[QueueWaitSet] = set()
        self._closed = False
        self._process = os.getpid()
        with self.bus.lock:
            self.bus.listeners.append(self._graph_changed)

    @property
    def graph(self) -> GraphView:
        return self._graph

    def _graph_changed(self) -> None:
        """Notify the graph's listeners on the reader thread."""
        self._reader.submit(self._graph.notify_changed)

    def replace_reader(self, reader: Reader) -> None:
        """Have ``reader`` do what the reader thread does, for nodes that are made from now on."""
        self._reader.close()
        self._reader = reader

    def create_node(self, name: str, namespace: str = "/") -> LocalNode:
        core = LocalNodeState(NodeInfo(name, namespace, self._enclave), self.bus, self._reader)
        node = LocalNode(self, core, self._forget)
        with self.bus.lock:
            self._require_open(f"create node {name}")
            self._nodes.append(node)
            self.bus.nodes.append(core.info)
        self.bus.changed()
        return node

    def _forget(self, node: LocalNode) -> None:
        """Forget a node that was closed."""
        with self.bus.lock:
            if node not in self._nodes:
                return
            self._nodes.remove(node)
            self.bus.nodes.remove(node.info)
        self.bus.changed()

    def create_wait_set(self) -> WaitSet:
        with self.bus.lock:
            self._require_open("create a wait set")
            wait_set = QueueWaitSet(self.bus.lock, self._wait_sets.discard)
            self._wait_sets.add(wait_set)
        return wait_set

    def call_when_ready(self, entity: Waitable, call: Callable[[], None]) -> Callable[[], None]:
        return call_when_queued(self.bus.lock, entity, call)

    def call_soon(self, call: Callable[[], None]) -> None:
        if self._process == os.getpid():  # a forked child has no reader thread
            self._reader.submit(call)

    def _require_open(self, what: str) -> None:
        if self._closed:
            raise WireError(f"{what}: the context is closed")

    def close(self) -> None:
        if self._process != os.getpid():  # see `Entity.close`
            return
        with self.bus.lock:
            if self._closed:
                return
            self._closed = True
            nodes = list(self._nodes)
        for node in nodes:
            node.close()
        for wait_set in list(self._wait_sets):
            wait_set.close()
        with self.bus.lock:
            self.bus.listeners.remove(self._graph_changed)
        self.bus.changed()
        self._graph.end_waits()
        self._reader.close()
