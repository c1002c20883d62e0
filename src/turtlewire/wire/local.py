"""The in-process middleware: the same contract as the real one, without a wire.

All contexts of one process and one domain see each other. Messages are handed over inside ``publish``, so what was published
before a ``take`` is there at the ``take``: tests need no waiting.
"""

from __future__ import annotations

import itertools
import threading
import time
from collections import deque
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from . import names
from .base import (
    Client,
    Context,
    EndpointInfo,
    Entity,
    MessageInfo,
    Node,
    NodeInfo,
    Publisher,
    Service,
    Subscription,
    TypeId,
    WaitSet,
)
from .graph import GraphView
from .qos import Durability, History, QoS, Reliability
from .report import warn_once
from .services import TopicClient, TopicService

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LocalContext"]

_gids = itertools.count(1)
_buses: dict[int, _Bus] = {}
_buses_lock = threading.Lock()


def _new_gid() -> bytes:
    return b"local" + next(_gids).to_bytes(11, "big")


class _Bus:
    """What joins the contexts of one domain: who publishes and who listens. Its lock guards all of its endpoints' state."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.contexts: list[LocalContext] = []
        self.publishers: list[_LocalPublisher] = []
        self.subscriptions: list[_LocalSubscription] = []

    def changed(self) -> None:
        """Tell every context that the graph is another one now."""
        with self.lock:
            contexts = list(self.contexts)
        for context in contexts:
            context.graph_changed()


def _compatible(publisher: _LocalPublisher, subscription: _LocalSubscription) -> bool:
    if (publisher.dds_topic, publisher.type_id.name) != (subscription.dds_topic, subscription.type_id.name):
        return False
    offered, requested = publisher.qos, subscription.qos
    best_effort_is_enough = requested.reliability == Reliability.BEST_EFFORT
    nothing_from_before = requested.durability != Durability.TRANSIENT_LOCAL
    return (best_effort_is_enough or offered.reliability != Reliability.BEST_EFFORT) and (
        nothing_from_before or offered.durability == Durability.TRANSIENT_LOCAL
    )


def _history(qos: QoS) -> deque[tuple[bytes, MessageInfo]]:
    return deque(maxlen=None if qos.history == History.KEEP_ALL else max(qos.depth, 1))


class _LocalPublisher(Publisher):
    def __init__(self, node: LocalNode, dds_topic: str, topic: str, type_id: TypeId, qos: QoS) -> None:
        self.topic = topic
        self.dds_topic = dds_topic
        self.type_id = type_id
        self.qos = qos
        self.gid = _new_gid()
        self.node = node
        self._bus = node.context.bus
        self._closed = False
        self._kept = _history(qos)
        with self._bus.lock:
            self._bus.publishers.append(self)

    def publish(self, cdr: bytes) -> None:
        """See :meth:`Publisher.publish`."""
        now = time.time_ns()
        message = (cdr, MessageInfo(now, now, self.gid))
        with self._bus.lock:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            if self.qos.durability == Durability.TRANSIENT_LOCAL:
                self._kept.append(message)
            for subscription in self._matched():
                subscription.receive(message)

    def kept(self) -> list[tuple[bytes, MessageInfo]]:
        """What a late joiner receives."""
        return list(self._kept)

    def _matched(self) -> list[_LocalSubscription]:
        return [subscription for subscription in self._bus.subscriptions if _compatible(self, subscription)]

    def subscription_count(self) -> int:
        """See :meth:`Publisher.subscription_count`."""
        with self._bus.lock:
            return 0 if self._closed else len(self._matched())

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self._bus.lock:
            if self._closed:
                return
            self._closed = True
            self._bus.publishers.remove(self)
        self._bus.changed()


class _LocalSubscription(Subscription):
    def __init__(
        self,
        node: LocalNode,
        dds_topic: str,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
    ) -> None:
        self.topic = topic
        self.dds_topic = dds_topic
        self.type_id = type_id
        self.qos = qos
        self.gid = _new_gid()
        self.node = node
        self._bus = node.context.bus
        self._closed = False
        self._queue = _history(qos)
        self._on_message = on_message
        self.wait_set: _LocalWaitSet | None = None
        with self._bus.lock:
            self._bus.subscriptions.append(self)
            if qos.durability == Durability.TRANSIENT_LOCAL:
                for publisher in self._bus.publishers:
                    if _compatible(publisher, self):
                        for message in publisher.kept():
                            self.receive(message)

    def receive(self, message: tuple[bytes, MessageInfo]) -> None:
        """Take over a message; called with the bus locked."""
        self._queue.append(message)
        if self._on_message is not None:
            self.node.context.reader.submit(self._deliver)
        elif self.wait_set is not None:
            self.wait_set.notify()

    def _deliver(self) -> None:
        """On the reader thread: hand over all waiting messages."""
        assert self._on_message is not None
        for message in self.take(limit=len(self._queue)):
            try:
                self._on_message(*message)
            except Exception as error:  # noqa: BLE001 - the reader thread serves others too
                warn_once(f"on_message {self.topic}", f"a message on {self.topic} was lost, its callback raised {error!r}")

    @property
    def is_ready(self) -> bool:
        """Whether messages are waiting."""
        return bool(self._queue)

    def take(self, limit: int = 32) -> list[tuple[bytes, MessageInfo]]:
        """See :meth:`Subscription.take`."""
        with self._bus.lock:
            return [self._queue.popleft() for _ in range(min(limit, len(self._queue)))]

    def publisher_count(self) -> int:
        """See :meth:`Subscription.publisher_count`."""
        with self._bus.lock:
            return 0 if self._closed else sum(_compatible(publisher, self) for publisher in self._bus.publishers)

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self._bus.lock:
            if self._closed:
                return
            self._closed = True
            self._bus.subscriptions.remove(self)
            self._queue.clear()
            if self.wait_set is not None:
                self.wait_set.detach_subscription(self)
        self._bus.changed()


class _LocalWaitSet(WaitSet):
    def __init__(self, bus: _Bus) -> None:
        self._bus = bus
        self._condition = threading.Condition(bus.lock)
        self._attached: dict[_LocalSubscription, Entity] = {}
        self._woken = False
        self._closed = False

    def attach(self, entity: Subscription | Client | Service) -> None:
        """See :meth:`WaitSet.attach`."""
        subscription = _readable_part(entity)
        with self._condition:
            if subscription.wait_set not in {None, self}:
                raise WireError(f"{subscription.topic} is attached to another wait set already")
            subscription.wait_set = self
            self._attached[subscription] = entity
            self._condition.notify_all()

    def detach(self, entity: Subscription | Client | Service) -> None:
        """See :meth:`WaitSet.detach`."""
        with self._condition:
            self.detach_subscription(_readable_part(entity))

    def detach_subscription(self, subscription: _LocalSubscription) -> None:
        """Forget a subscription; called with the bus locked."""
        if self._attached.pop(subscription, None) is not None:
            subscription.wait_set = None

    def notify(self) -> None:
        """A message came for an attached subscription; called with the bus locked."""
        self._condition.notify_all()

    def wait(self, timeout_ns: int | None = None) -> list[Entity]:
        """See :meth:`WaitSet.wait`."""
        with self._condition:
            self._condition.wait_for(self._has_news, None if timeout_ns is None else timeout_ns / 1e9)
            self._woken = self._closed
            return [entity for subscription, entity in self._attached.items() if subscription.is_ready]

    def _has_news(self) -> bool:
        return self._woken or any(subscription.is_ready for subscription in self._attached)

    def wake(self) -> None:
        """See :meth:`WaitSet.wake`."""
        with self._condition:
            self._woken = True
            self._condition.notify_all()

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self._condition:
            self._closed = True
            for subscription in list(self._attached):
                self.detach_subscription(subscription)
            self.wake()


def _readable_part(entity: Subscription | Client | Service) -> _LocalSubscription:
    if isinstance(entity, TopicClient):
        entity = entity.replies
    elif isinstance(entity, TopicService):
        entity = entity.requests
    assert isinstance(entity, _LocalSubscription)
    return entity


class LocalNode(Node):
    """A node of a :class:`LocalContext`."""

    def __init__(self, context: LocalContext, name: str, namespace: str, enclave: str) -> None:
        self.context = context
        self.name = name
        self.namespace = namespace
        self.info = NodeInfo(name, namespace, enclave)
        self._entities: list[Entity] = []

    def create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        """See :meth:`Node.create_publisher`."""
        publisher = _LocalPublisher(self, _dds_topic(topic, qos), topic, type_id, qos)
        self._add(publisher)
        return publisher

    def create_subscription(
        self, topic: str, type_id: TypeId, qos: QoS, on_message: Callable[[bytes, MessageInfo], None] | None = None
    ) -> Subscription:
        """See :meth:`Node.create_subscription`."""
        subscription = _LocalSubscription(self, _dds_topic(topic, qos), topic, type_id, qos, on_message)
        self._add(subscription)
        return subscription

    def create_client(self, service: str, request: TypeId, response: TypeId, qos: QoS) -> Client:
        """See :meth:`Node.create_client`."""
        replies = _LocalSubscription(self, names.reply_topic(service), service, response, qos)
        requests = _LocalPublisher(self, names.request_topic(service), service, request, qos)
        client = TopicClient(service, int.from_bytes(requests.gid[-8:], "big"), requests, replies)
        self._add(client)
        return client

    def create_service(self, service: str, request: TypeId, response: TypeId, qos: QoS) -> Service:
        """See :meth:`Node.create_service`."""
        requests = _LocalSubscription(self, names.request_topic(service), service, request, qos)
        replies = _LocalPublisher(self, names.reply_topic(service), service, response, qos)
        server = TopicService(service, requests, replies)
        self._add(server)
        return server

    def _add(self, entity: Entity) -> None:
        self._entities.append(entity)
        self.context.bus.changed()

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        for entity in self._entities:
            entity.close()
        self._entities.clear()
        self.context.remove_node(self)


def _dds_topic(topic: str, qos: QoS) -> str:
    return topic if qos.avoid_ros_namespace_conventions else names.topic_to_dds(topic)


class _LocalGraph(GraphView):
    def __init__(self, bus: _Bus) -> None:
        super().__init__()
        self._bus = bus

    def nodes(self) -> list[NodeInfo]:
        """See :meth:`Graph.nodes`."""
        with self._bus.lock:
            return [node.info for context in self._bus.contexts for node in context.nodes]

    def endpoints(self) -> list[EndpointInfo]:
        """See :meth:`Graph.endpoints`."""
        with self._bus.lock:
            publishers = [_endpoint_info("publisher", publisher) for publisher in self._bus.publishers]
            return publishers + [_endpoint_info("subscription", subscription) for subscription in self._bus.subscriptions]


def _endpoint_info(kind: str, endpoint: _LocalPublisher | _LocalSubscription) -> EndpointInfo:
    topic = names.topic_from_dds(endpoint.dds_topic) or endpoint.dds_topic
    return EndpointInfo(kind, topic, *endpoint.type_id, endpoint.node.info, endpoint.gid, endpoint.qos)


class _ReaderThread:
    """Runs what is submitted, in order, on one thread that starts with the first submission."""

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._work: deque[Callable[[], None]] = deque()
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` soon."""
        with self._condition:
            if self._closed:
                return
            self._work.append(work)
            self._condition.notify()
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="turtlewire-reader", daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._work or self._closed)
                if self._closed:
                    return
                work = self._work.popleft()
            work()

    def close(self) -> None:
        """End the thread and join it, unless this is it."""
        with self._condition:
            self._closed = True
            self._condition.notify()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()


class LocalContext(Context):
    """A participant of an in-process domain."""

    def __init__(self, domain_id: int) -> None:
        self.domain_id = domain_id
        self.gid = _new_gid()
        self.nodes: list[LocalNode] = []
        self.reader = _ReaderThread()
        with _buses_lock:
            self.bus = _buses.setdefault(domain_id, _Bus())
        self._graph = _LocalGraph(self.bus)
        self._wait_sets: list[_LocalWaitSet] = []
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
            if self._closed:
                raise WireError(f"create node {name}: the context is closed")
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
        wait_set = _LocalWaitSet(self.bus)
        self._wait_sets.append(wait_set)
        return wait_set

    def close(self) -> None:
        """See :meth:`Context.close`."""
        with self.bus.lock:
            if self._closed:
                return
            self._closed = True
            nodes = list(self.nodes)
        for node in nodes:
            node.close()
        for wait_set in self._wait_sets:
            wait_set.close()
        with self.bus.lock:
            self.bus.contexts.remove(self)
        self.bus.changed()
        self._graph.end_waits()
        self.reader.close()
