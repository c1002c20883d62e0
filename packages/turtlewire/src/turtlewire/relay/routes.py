"""One topic or service in one direction. Clients at the far end call a server at the near end."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

from turtlewire import msg
from turtlewire.errors import InterfaceError, WireError
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import Durability, History, QoS, Reliability

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Node, Publisher, RequestId, Service, Subscription

    from .side import Side

#: Unused endpoints stay open for this time, so that messages sent just before still arrive.
_LINGER_S = 2.0
#: How long a message waits for the discovery of its publisher.
_PATIENCE_S = 3.0
_DEPTH = 100


class _Kind(NamedTuple):
    """The policies by which the subscriptions of a route differ."""

    reliability: Reliability
    durability: Durability


class _Copy(NamedTuple):
    """A publisher at the far end that represents one at the near end."""

    publisher: Publisher
    node: Node
    kind: _Kind


class TopicRoute:
    """Carries one topic: a publisher at the far end for each one at the near end.

    Each publisher keeps its own QoS and, if latched, its history for late subscriptions. The near
    end is subscribed to only while the far end has subscriptions, so unused topics cost nothing.

    Args:
        near: Where messages come from.
        far: Where they go.
        topics: The names of the topic at the two ends.
        type_id: Its type.
        convert: Changes messages on the way; returns None for those that are not carried.
    """

    def __init__(
        self,
        near: Side,
        far: Side,
        topics: tuple[str, str],
        type_id: TypeId,
        convert: Callable[[bytes], bytes | None] | None,
    ) -> None:
        self._near, self._far = near, far
        self._near_topic, self._far_topic = topics
        self._type_id = type_id
        self._convert = convert
        self._known = threading.Condition()
        self._copies: dict[bytes, _Copy] = {}
        self._own: set[bytes] = set()
        self._relayed: set[bytes] = set()
        self._subscriptions: dict[_Kind, Subscription] = {}
        self._unused: dict[bytes | _Kind, float] = {}

    @property
    def is_empty(self) -> bool:
        """True if nothing is left of it."""
        return not self._copies and not self._subscriptions

    @property
    def nodes(self) -> set[Node]:
        """The nodes of the far end that own its publishers."""
        return {copy.node for copy in self._copies.values()}

    def update(
        self,
        publishers: list[EndpointInfo],
        subscriptions: list[EndpointInfo],
        relayed: set[bytes],
        node_for: Callable[[EndpointInfo], Node],
    ) -> float | None:
        """Follow the graphs.

        Args:
            publishers: Those at the near end.
            subscriptions: Those at the far end.
            relayed: The gids of endpoints of relays at the near end.
            node_for: Returns the node at the far end that represents an endpoint's.

        Returns:
            When to look again (monotonic seconds), or None.
        """
        for publisher in publishers:
            if publisher.gid not in self._copies:
                self._copy(publisher, node_for(publisher))
        models = (publishers or subscriptions) if subscriptions else []
        kinds = {_Kind(model.qos.reliability, model.qos.durability) for model in models}
        for kind in kinds - self._subscriptions.keys():
            self._subscribe(kind)
        with self._known:
            self._relayed = relayed
            self._known.notify_all()
        return self._drop_unused({publisher.gid for publisher in publishers} | kinds)

    def _copy(self, publisher: EndpointInfo, node: Node) -> None:
        qos = publisher.qos
        if qos.history not in {History.KEEP_LAST, History.KEEP_ALL}:  # Fast DDS announces none
            qos = qos._replace(history=History.KEEP_LAST, depth=QoS().depth)
        copy = node.create_publisher(self._far_topic, self._type_id, qos)
        kind = _Kind(publisher.qos.reliability, publisher.qos.durability)
        with self._known:
            self._copies[publisher.gid] = _Copy(copy, node, kind)

    def _subscribe(self, kind: _Kind) -> None:
        qos = QoS(depth=_DEPTH, reliability=kind.reliability, durability=kind.durability)
        subscription = self._near.node.create_subscription(self._near_topic, self._type_id, qos)
        self._subscriptions[kind] = subscription
        self._near.serve(subscription, lambda: self._carry(kind, subscription))

    def _drop_unused(self, used: set[bytes | _Kind]) -> float | None:
        """Close what has not been used for a while; return when to look again."""
        now = time.monotonic()
        ours = self._copies.keys() | self._subscriptions.keys()
        self._unused = {key: self._unused.get(key, now) for key in ours - used}
        for key, since in list(self._unused.items()):
            if now - since >= _LINGER_S:
                del self._unused[key]
                self._drop(key)
        return min(self._unused.values(), default=now) + _LINGER_S if self._unused else None

    def _drop(self, key: bytes | _Kind) -> None:
        if isinstance(key, bytes):
            with self._known:
                copy = self._copies.pop(key)
            copy.publisher.close()
        else:
            self._near.forget(self._subscriptions.pop(key))

    def _carry(self, kind: _Kind, subscription: Subscription) -> None:
        """Carry messages; runs on the thread of the near end."""
        for cdr, info in subscription.take():
            copy = self._copy_of(info.publisher_gid)
            # A publisher can match several of our subscriptions; only that of its kind counts.
            if copy is None or (copy.kind != kind and copy.kind in self._subscriptions):
                continue
            converted = cdr if self._convert is None else self._convert(cdr)
            if converted is not None:
                try:
                    copy.publisher.publish(converted)
                except WireError as error:  # the other messages are carried
                    self._far.warn(error)

    def _copy_of(self, gid: bytes) -> _Copy | None:
        """Return the publisher that represents another; None for one of a relay."""
        copy = self._copies.get(gid)
        if copy is None and gid not in self._relayed:
            with self._known:
                self._known.wait_for(
                    lambda: gid in self._copies or gid in self._relayed, _PATIENCE_S
                )
                copy = self._copies.get(gid)
        return copy

    def close(self) -> None:
        """Close everything."""
        for gid in list(self._copies):
            self._drop(gid)
        for kind in list(self._subscriptions):
            self._drop(kind)


#: Largest number of requests that wait for a response; beyond it, the oldest is dropped.
_MOST_PENDING = 1000


class ServiceRoute:
    """Carries the requests and responses of one service.

    Args:
        near: Where the server is.
        far: Where its clients are.
        name: The service at the near end.
        types: Its types.
    """

    def __init__(self, near: Side, far: Side, name: str, types: ServiceTypes) -> None:
        self._near, self._far = near, far
        self.types = types
        self._client = near.node.create_client(name, types, QoS())
        self._service: Service | None = None
        self.node: Node | None = None
        self._lock = threading.Lock()
        self._pending: dict[int, RequestId] = {}
        near.serve(self._client, self._carry_responses)

    def offer(self, name: str, node: Node) -> bool:
        """Offer the service at the far end once the server can be called.

        Returns:
            True if it is offered from now on.
        """
        if self._service is not None or not self._client.is_ready():
            return False
        self._service, self.node = node.create_service(name, self.types, QoS()), node
        service = self._service
        self._far.serve(service, lambda: self._carry_requests(service))
        return True

    def _carry_requests(self, service: Service) -> None:
        """Carry requests to the server; runs on the thread of the far end."""
        for request_id, cdr in service.take():
            self._call(request_id, cdr)

    def _call(self, request_id: RequestId, cdr: bytes) -> None:
        try:
            with self._lock:  # the response may arrive before the number is returned
                self._pending[self._client.send_request(cdr)] = request_id
                if len(self._pending) > _MOST_PENDING:
                    del self._pending[next(iter(self._pending))]
        except WireError as error:
            self._near.warn(error)

    def _carry_responses(self) -> None:
        """Carry responses back; runs on the thread of the near end."""
        for number, cdr in self._client.take():
            with self._lock:
                request_id = self._pending.pop(number, None)
            if request_id is not None and self._service is not None:
                try:
                    self._service.send_response(request_id, cdr)
                except WireError as error:  # the other responses are carried
                    self._far.warn(error)

    def close(self) -> None:
        """Close both halves."""
        if self._service is not None:
            self._far.forget(self._service)
        self._near.forget(self._client)


def service_types(
    type_name: str, on_dds: Iterable[EndpointInfo], on_zenoh: Iterable[EndpointInfo]
) -> ServiceTypes:
    """Return the types of a service; a hash that is not known is empty.

    On DDS, the two halves of a service announce the hashes of their own types. On Zenoh, both
    announce the hash of the service, which cannot be computed from those. So the hash of a service
    without an installed definition is known only once an end on Zenoh has announced it.

    Args:
        type_name: Name of the type (``turtlesim/srv/Spawn``).
        on_dds: Its servers and clients on DDS.
        on_zenoh: Its servers and clients on Zenoh.
    """
    parts = f"{type_name}_Request", f"{type_name}_Response"
    announced = {each.type_name: each.type_hash for each in on_dds if each.type_hash}
    installed = {name: installed_hash(name) for name in (type_name, *parts)}
    is_another = any(announced.get(part, installed[part]) != installed[part] for part in parts)
    hashes = (each.type_hash for each in on_zenoh if each.type_name in parts)
    whole = next(hashes, "" if is_another else installed[type_name])
    request, response = (TypeId(part, announced.get(part, installed[part])) for part in parts)
    return ServiceTypes(type_name, request, response, lambda _: whole)


def installed_hash(type_name: str) -> str:
    """Return the hash of an installed definition; empty if it is not installed."""
    try:
        return msg.type_hash(type_name)
    except InterfaceError:
        return ""
