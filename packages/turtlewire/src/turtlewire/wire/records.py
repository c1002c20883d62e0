"""Records of names, stamps and counts that a middleware accepts and returns."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from .qos import QoS


class TypeId(NamedTuple):
    """The name and hash of a type, which peers compare.

    Attributes:
        name: ROS name, for example ``tf2_msgs/msg/TFMessage`` or ``turtlesim/srv/Spawn_Request``.
        type_hash: ``RIHS01_`` and 64 hex digits.
    """

    name: str
    type_hash: str


class ServiceTypes(NamedTuple):
    """The names and hashes of a service's types, which peers compare.

    Attributes:
        name: ROS name (``turtlesim/srv/Spawn``).
        request: Type of the requests.
        response: Type of the responses.
        hash_of: Returns the hash of the service's type, for middlewares that need it.
    """

    name: str
    request: TypeId
    response: TypeId
    hash_of: Callable[[str], str]

    def service_id(self) -> TypeId:
        """Return the service itself, with its hash."""
        return TypeId(self.name, self.hash_of(self.name))

    def announced_hash(self) -> str:
        """Return the hash that the endpoints of the service announce; Jazzy's announce none."""
        return self.hash_of(self.name) if since(LYRICAL) else ""


class MessageInfo(NamedTuple):
    """The metadata of a received message.

    Attributes:
        source_timestamp_ns: When the sender wrote it, system time.
        received_timestamp_ns: When it was taken here, system time.
        publisher_gid: 16 bytes that identify the publisher.
        publication_number: The publisher's count of its messages, from 1; None if the middleware
            does not report it (Cyclone DDS).
    """

    source_timestamp_ns: int
    received_timestamp_ns: int
    publisher_gid: bytes
    publication_number: int | None = None


class RequestId(NamedTuple):
    """Identifies a service request.

    Attributes:
        client_id: Unsigned, of 8 bytes (Cyclone DDS) or 16 (Zenoh).
        sequence_number: Counted by the client.
    """

    client_id: int
    sequence_number: int


class NodeInfo(NamedTuple):
    """A node that the graph knows."""

    name: str
    namespace: str
    enclave: str


class EndpointInfo(NamedTuple):
    """One end of a topic (service endpoints are topics too; :class:`Graph` splits them).

    Attributes:
        kind: ``"publisher"`` or ``"subscription"``.
        topic: Demangled ROS name, or the raw DDS name when it is not a ROS topic.
        type_name: ROS name (``turtlesim/msg/Pose``), or the raw DDS name.
        type_hash: ``RIHS01_...`` or an empty string when the peer says none.
        node: The node that owns it, or None when no node claims it.
        gid: 16 bytes.
        qos: As the peer announced it.
        service_hash: Of an endpoint of a service: the hash of the service's type, or an empty
            string when the peer says none.
    """

    kind: str
    topic: str
    type_name: str
    type_hash: str
    node: NodeInfo | None
    gid: bytes
    qos: QoS
    service_hash: str = ""


class ForeignServer(NamedTuple):
    """The server of a service that would misread our requests.

    Attributes:
        service: Fully qualified ROS name.
        node: The node that owns it, or None when no node claims it.
        middleware: Name of the middleware on which it runs.
        is_rival: Whether it would not misread them if the service had no server on another
            middleware, which would.
    """

    service: str
    node: NodeInfo | None
    middleware: str
    is_rival: bool = False


class EventKind(Enum):
    """A change of circumstances that an endpoint can report."""

    MATCHED = "matched"
    INCOMPATIBLE_QOS = "incompatible QoS"
    DEADLINE_MISSED = "deadline missed"
    LIVELINESS_LOST = "liveliness lost"  # publishers only
    LIVELINESS_CHANGED = "liveliness changed"  # subscriptions only
    MESSAGE_LOST = "message lost"  # subscriptions only
    INCOMPATIBLE_TYPE = "incompatible type"  # accepted, and never reported by any middleware


class EventStatus(NamedTuple):
    """Counters of an event; changes are counted since the last :meth:`Event.take`.

    Attributes:
        total_count: How often it happened. ``LIVELINESS_CHANGED``: how many matching publishers are
            not alive.
        total_count_change: Change of it.
        current_count: ``MATCHED``: how many match at the moment. ``LIVELINESS_CHANGED``: how many
            of them are alive.
        current_count_change: Change of it.
        last_policy_kind: ``INCOMPATIBLE_QOS``: the policy that did not fit last, as a number of
            rmw's ``rmw_qos_policy_kind_t`` (DURABILITY 2, DEADLINE 4, LIVELINESS 8, RELIABILITY 16,
            HISTORY 32, LIFESPAN 64; INVALID 1).
    """

    total_count: int = 0
    total_count_change: int = 0
    current_count: int = 0
    current_count_change: int = 0
    last_policy_kind: int = 1
