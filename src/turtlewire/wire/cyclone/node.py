"""A node: makes endpoints, and keeps the announcement of them up to date."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from turtlewire.wire import names
from turtlewire.wire.base import Client, Entity, MessageInfo, Node, Publisher, Service, Subscription

from .announcer import NodeRecord
from .endpoints import CyclonePublisher, CycloneSubscription, dds_topic_name, deliver_to
from .services import CycloneClient, CycloneService, format_service_id

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS

    from .context import CycloneContext

__all__ = ["CycloneNode"]


class CycloneNode(Node):
    """A node of a :class:`CycloneContext`."""

    def __init__(self, context: CycloneContext, name: str, namespace: str) -> None:
        self.context = context
        self.name = name
        self.namespace = namespace
        self._participant = context.participant
        self._reader = context.reader
        self._lock = threading.Lock()
        self._entities: dict[Entity, None] = {}
        self._record = NodeRecord(namespace, name)
        context.announcer.add(self._record)

    def create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        """See :meth:`Node.create_publisher`."""
        return self._publisher(dds_topic_name(topic, qos), type_id, qos, topic=topic)

    def create_subscription(
        self, topic: str, type_id: TypeId, qos: QoS, on_message: Callable[[bytes, MessageInfo], None] | None = None
    ) -> Subscription:
        """See :meth:`Node.create_subscription`."""
        subscription = self._subscription(dds_topic_name(topic, qos), type_id, qos, topic=topic)
        if on_message is not None:
            self._reader.watch(subscription.condition(), deliver_to(subscription, on_message))
        return subscription

    def create_client(self, service: str, request: TypeId, response: TypeId, qos: QoS) -> Client:
        """See :meth:`Node.create_client`."""
        client_id = format_service_id(self._participant.gid, self.context.next_service_number())
        requests = self._publisher(names.request_topic(service), request, qos, topic=service, clientid=client_id)
        replies = self._subscription(names.reply_topic(service), response, qos, topic=service, clientid=client_id)
        return CycloneClient(service, requests, replies)

    def create_service(self, service: str, request: TypeId, response: TypeId, qos: QoS) -> Service:
        """See :meth:`Node.create_service`."""
        service_id = format_service_id(self._participant.gid, self.context.next_service_number())
        replies = self._publisher(names.reply_topic(service), response, qos, topic=service, serviceid=service_id)
        requests = self._subscription(names.request_topic(service), request, qos, topic=service, serviceid=service_id)
        server = CycloneService(service, requests, replies, self._reader)
        replies.on_matched = server.matched
        return server

    def _publisher(self, dds_topic: str, type_id: TypeId, qos: QoS, *, topic: str, **user_data: str) -> CyclonePublisher:
        publisher = CyclonePublisher(self._participant, dds_topic, type_id, qos, topic=topic, **user_data)
        self._adopt(publisher, self._record.writers)
        return publisher

    def _subscription(self, dds_topic: str, type_id: TypeId, qos: QoS, *, topic: str, **user_data: str) -> CycloneSubscription:
        subscription = CycloneSubscription(self._participant, dds_topic, type_id, qos, topic=topic, **user_data)
        self._adopt(subscription, self._record.readers)
        return subscription

    def _adopt(self, endpoint: CyclonePublisher | CycloneSubscription, gids: list[bytes]) -> None:
        """Announce an endpoint until it closes, and watch whom it matches."""

        def matched() -> None:
            endpoint.clear_matched()
            endpoint.on_matched()
            self.context.graph_changed()

        def closing() -> None:
            self._reader.unwatch(endpoint.handle)
            with self._lock:
                self._entities.pop(endpoint, None)
                gids.remove(endpoint.gid)
            self.context.announcer.changed()

        endpoint.on_closing = closing
        with self._lock:
            self._entities[endpoint] = None
            gids.append(endpoint.gid)
        self._reader.watch(endpoint.handle, matched)
        self.context.announcer.changed()

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self._lock:
            entities = list(self._entities)
        for entity in entities:
            entity.close()
        self.context.remove_node(self, self._record)
