"""Nodes of the in-process middleware, and the state that they share with their endpoints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.wire import names
from turtlewire.wire.base import Client, MessageInfo, Publisher, Service, Subscription
from turtlewire.wire.checked_node import CheckedNode
from turtlewire.wire.graph import with_best_available
from turtlewire.wire.services import TopicClient, TopicService

from .endpoint import LocalEndpointSpec, LocalPublisher, LocalSubscription

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Context, NodeInfo, ServiceTypes, Sink, TypeId
    from turtlewire.wire.qos import QoS
    from turtlewire.wire.reader_thread import Reader

    from .bus import Bus
    from .endpoint import LocalEndpoint

__all__ = ["LocalNode", "LocalNodeState"]


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
