"""A node, and what its context shares with it.

It makes endpoints, and keeps the announcement of them up to date.
"""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable
from contextlib import ExitStack
from functools import cached_property
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.checked_node import CheckedNode
from turtlewire.wire.graph import with_best_available

from .announcer import Announcer, NodeRecord
from .endpoint import Endpoint, EndpointSpec
from .fast_dds import receiving_addresses
from .participant import Participant
from .publisher import CyclonePublisher
from .reader import CycloneReaderThread
from .servers import ONLY_CYCLONE
from .services import CycloneClient, CycloneService, format_service_id
from .subscription import CycloneSubscription, deliver_rest_to, deliver_to

if TYPE_CHECKING:
    from turtlewire.wire.base import (
        Client,
        Context,
        MessageInfo,
        Publisher,
        Service,
        ServiceTypes,
        Sink,
        Subscription,
        TypeId,
    )
    from turtlewire.wire.qos import QoS

    from .graph import CycloneGraph


class CycloneContextState:
    """Participant, reader thread and announcements, which a context shares with its nodes.

    Attributes:
        graph: None until the context is first asked for it: a program that never looks at the
            graph does not read what peers announce.
        closing: Whether the context is being closed.
    """

    def __init__(self, domain_id: int, enclave: str) -> None:
        self.participant = Participant(domain_id, enclave)
        with ExitStack() as if_it_fails:
            if_it_fails.callback(self.participant.close)
            self.reader = CycloneReaderThread(self.participant.handle)
            if_it_fails.callback(self.reader.close)
            self.announcer = Announcer(self.participant, self.reader)
            if_it_fails.pop_all()
        self.graph: CycloneGraph | None = None
        self.closing = False
        self._service_numbers = itertools.count(1)

    @cached_property
    def receiving_addresses(self) -> list[tuple[int, int]]:
        """The IPv4 addresses, as numbers, and ports at which this process receives."""
        return receiving_addresses(self.participant.domain_id)

    def graph_changed(self) -> None:
        """Notify the graph's listeners; called when a predicate on the graph may have changed."""
        if self.graph is not None:
            self.graph.notify_changed()

    def next_service_number(self) -> int:
        """Numbers the clients and services of this participant."""
        return next(self._service_numbers)


class CycloneNode(CheckedNode):
    """A node of a context.

    Args:
        context: The context that makes it.
        core: What the context shares with its nodes.
        name: Its name.
        namespace: Its namespace.
        on_closed: Called when it is closed.
    """

    def __init__(
        self,
        context: Context,
        core: CycloneContextState,
        name: str,
        namespace: str,
        on_closed: Callable[[CycloneNode], None],
    ) -> None:
        super().__init__()
        self.context = context
        self._core = core
        self._on_closed = on_closed
        self.name = name
        self.namespace = namespace
        self._lock = threading.Lock()
        self._endpoints: dict[Endpoint, None] = {}
        self.record = NodeRecord(namespace, name)
        core.announcer.add(self.record)

    def _create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        qos = with_best_available(qos, topic, "publisher", self.context)
        dds_topic = names.topic_to_dds(topic, bare=qos.avoid_ros_namespace_conventions)
        return self._publisher(EndpointSpec(topic, dds_topic, type_id, qos))

    def _create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None,
        sink: Sink | None,
    ) -> Subscription:
        qos = with_best_available(qos, topic, "subscription", self.context)
        dds_topic = names.topic_to_dds(topic, bare=qos.avoid_ros_namespace_conventions)
        subscription = self._subscription(EndpointSpec(topic, dds_topic, type_id, qos), sink)
        if on_message is not None:
            self._serve(subscription, on_message)
        return subscription

    def _serve(
        self, subscription: CycloneSubscription, on_message: Callable[[bytes, MessageInfo], None]
    ) -> None:
        """Call ``on_message`` on the reader thread until the subscription closes."""
        inlet = subscription.inlet
        if inlet is None:
            condition, deliver = subscription.condition(), deliver_to(subscription, on_message)
        else:
            condition, deliver = inlet.guard, deliver_rest_to(subscription, inlet, on_message)
        subscription.on_closing.append(lambda: self._core.reader.unwatch(condition))
        self._core.reader.watch(condition, deliver)

    def _create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        identity = self._identity("clientid", types)
        spec = EndpointSpec(service, names.request_topic(service), types.request, qos, identity)
        with ExitStack() as if_it_fails:
            requests = self._publisher(spec._replace(partition=ONLY_CYCLONE))
            if_it_fails.callback(requests.close)
            replies = self._subscription(
                EndpointSpec(service, names.reply_topic(service), types.response, qos, identity)
            )
            if_it_fails.callback(replies.close)
            client = CycloneClient(service, requests, replies, lambda: self._publisher(spec))
            if_it_fails.pop_all()
        return client

    def _create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        identity = self._identity("serviceid", types)
        with ExitStack() as if_it_fails:
            replies = self._publisher(
                EndpointSpec(service, names.reply_topic(service), types.response, qos, identity)
            )
            if_it_fails.callback(replies.close)
            requests = self._subscription(
                EndpointSpec(service, names.request_topic(service), types.request, qos, identity)
            )
            if_it_fails.callback(requests.close)
            server = CycloneService(
                service, requests, replies, self._core.reader, self._core.receiving_addresses
            )
            if_it_fails.pop_all()
        replies.on_matched.append(server.matched)
        return server

    def _identity(self, key: str, types: ServiceTypes) -> dict[str, str]:
        """Return the user data of both halves of a client or server, without message hashes."""
        number = self._core.next_service_number()
        identity = {key: format_service_id(self.context.gid, number)}
        service_hash = types.announced_hash()
        return {**identity, "sertypehash": service_hash} if service_hash else identity

    def _publisher(self, spec: EndpointSpec) -> CyclonePublisher:
        publisher = CyclonePublisher(self._core.participant, spec)
        self._adopt(publisher, self.record.writers)
        return publisher

    def _subscription(self, spec: EndpointSpec, sink: Sink | None = None) -> CycloneSubscription:
        subscription = CycloneSubscription(self._core.participant, spec, sink=sink)
        self._adopt(subscription, self.record.readers)
        return subscription

    def _adopt(self, endpoint: Endpoint, gids: list[bytes]) -> None:
        """Announce an endpoint until it closes, and watch its statuses.

        Raises:
            WireError: The node is closed; the endpoint is closed then.
        """

        def closing() -> None:
            self._core.reader.unwatch(endpoint.handle)
            with self._lock:
                self._endpoints.pop(endpoint, None)
                gids.remove(endpoint.gid)
            self._core.announcer.changed()

        endpoint.on_closing.append(closing)
        endpoint.on_matched.append(self._core.graph_changed)
        with self._lock:
            self._endpoints[endpoint] = None
            gids.append(endpoint.gid)
        self._core.reader.watch(endpoint.handle, endpoint.statuses_changed)
        self._core.announcer.changed()
        if self._closed:  # by another thread, which may not have seen this endpoint
            endpoint.close()
            raise WireError(f"create an endpoint of {endpoint.spec.name}: the node is closed")

    def _close(self) -> None:
        with self._lock:
            endpoints = list(self._endpoints)
        for endpoint in endpoints:
            endpoint.ends_with_participant = self._core.closing
            endpoint.close()
        self._on_closed(self)
