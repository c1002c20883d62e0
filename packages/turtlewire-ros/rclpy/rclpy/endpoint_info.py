"""Information about the endpoints of topics and services in the graph.

In Jazzy and Kilted, the module is called ``topic_endpoint_info``; there it only
covers topics.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import IntEnum
from typing import TYPE_CHECKING, Any

from turtlewire.wire import names

from .impl.hints import checked_property
from .qos import HistoryPolicy, QoSProfile, qos_profile_unknown
from .type_hash import TypeHash

if TYPE_CHECKING:
    from turtlewire.wire import base

_PROCESS_OF_GID = 12
_UNKNOWN_HASH = TypeHash()
_UNKNOWN_NAME = "_NODE_NAME_UNKNOWN_"
_UNKNOWN_NAMESPACE = "_NODE_NAMESPACE_UNKNOWN_"


class EndpointTypeEnum(IntEnum):
    """The kinds of endpoints: publisher, subscription, client, server."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2
    CLIENT = 3
    SERVER = 4


class _EndpointInfo:
    """The node of an end of a topic or service; two with equal members are equal."""

    node_name: str = checked_property("node_name", str, "Name of the node that owns it.")
    node_namespace: str = checked_property("node_namespace", str, "Namespace of that node.")

    __hash__ = None  # type: ignore[assignment]  # mutable

    def __eq__(self, other: object) -> bool:
        return vars(self) == vars(other) if isinstance(other, type(self)) else NotImplemented


class TopicEndpointInfo(_EndpointInfo):
    """One end of a topic."""

    topic_type: str = checked_property(
        "topic_type", str, "For example ``geometry_msgs/msg/Twist``."
    )
    topic_type_hash: TypeHash = checked_property(
        "topic_type_hash", TypeHash, "Hash of the type's definition."
    )
    endpoint_type: EndpointTypeEnum = checked_property(
        "endpoint_type", EndpointTypeEnum, "Publisher or subscription."
    )
    endpoint_gid: list[int] = checked_property("endpoint_gid", list, "16 numbers that identify it.")
    qos_profile: QoSProfile = checked_property("qos_profile", QoSProfile, "As it was announced.")

    def __init__(
        self,
        node_name: str = "",
        node_namespace: str = "",
        topic_type: str = "",
        topic_type_hash: TypeHash = _UNKNOWN_HASH,
        endpoint_type: EndpointTypeEnum = EndpointTypeEnum.INVALID,
        endpoint_gid: list[int] = [],  # noqa: B006 - copied
        qos_profile: QoSProfile = qos_profile_unknown,
    ) -> None:
        self.node_name = node_name
        self.node_namespace = node_namespace
        self.topic_type = topic_type
        self.topic_type_hash = topic_type_hash
        self.endpoint_type = endpoint_type
        self.endpoint_gid = list(endpoint_gid)
        self.qos_profile = qos_profile

    @classmethod
    def from_wire(cls, endpoint: base.EndpointInfo) -> TopicEndpointInfo:
        """Convert from what the middleware reports.

        An endpoint that no node claims gets ROS 2's names for that.
        """
        return cls(
            **_owner(endpoint),
            topic_type=endpoint.type_name,
            topic_type_hash=TypeHash.from_string(endpoint.type_hash),
            endpoint_type=EndpointTypeEnum[endpoint.kind.upper()],
            endpoint_gid=list(endpoint.gid),
            qos_profile=QoSProfile.from_wire(endpoint.qos),
        )

    def __str__(self) -> str:
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Topic type: {self.topic_type}",
                f"Topic type hash: {self.topic_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"GID: {_hexadecimal(self.endpoint_gid)}",
                "QoS profile:",
                *(f"  {line}" for line in _qos_lines(self.qos_profile)),
            ]
        )


class ServiceEndpointInfo(_EndpointInfo):
    """A client or server of a service.

    On DDS it has two endpoints; of ``qos_profiles`` and ``endpoint_gids``, the first belongs to its
    reader and the second to its writer. On Zenoh it has one.
    """

    service_type: str = checked_property(
        "service_type", str, "For example ``turtlesim/srv/Spawn``."
    )
    service_type_hash: TypeHash = checked_property(
        "service_type_hash", TypeHash, "Hash of the service's definition; Jazzy announces none."
    )
    qos_profiles: list[QoSProfile] = checked_property(
        "qos_profiles", list, "As they were announced."
    )
    endpoint_gids: list[list[int]] = checked_property(
        "endpoint_gids", list, "Of each endpoint, 16 numbers that identify it."
    )
    endpoint_type: EndpointTypeEnum = checked_property(
        "endpoint_type", EndpointTypeEnum, "Client or server."
    )
    endpoint_count: int = checked_property("endpoint_count", int, "1 or 2.")

    def __init__(
        self,
        node_name: str = "",
        node_namespace: str = "",
        service_type: str = "",
        service_type_hash: TypeHash = _UNKNOWN_HASH,
        qos_profiles: list[QoSProfile] = [],  # noqa: B006 - copied
        endpoint_gids: list[list[int]] = [],  # noqa: B006 - copied
        endpoint_type: EndpointTypeEnum = EndpointTypeEnum.INVALID,
        endpoint_count: int = 0,
    ) -> None:
        self.node_name = node_name
        self.node_namespace = node_namespace
        self.service_type = service_type
        self.service_type_hash = service_type_hash
        self.qos_profiles = list(qos_profiles)
        self.endpoint_gids = list(endpoint_gids)
        self.endpoint_type = endpoint_type
        self.endpoint_count = endpoint_count

    @classmethod
    def from_wire(
        cls, endpoint_type: EndpointTypeEnum, reader: base.EndpointInfo, writer: base.EndpointInfo
    ) -> ServiceEndpointInfo:
        """Convert from what the middleware reports of the two halves of a client or server."""
        endpoints = [reader] if reader.gid == writer.gid else [reader, writer]
        return cls(
            **_owner(reader),
            service_type=names.service_type(reader.type_name),
            service_type_hash=TypeHash.from_string(reader.service_hash),
            qos_profiles=[QoSProfile.from_wire(endpoint.qos) for endpoint in endpoints],
            endpoint_gids=[list(endpoint.gid) for endpoint in endpoints],
            endpoint_type=endpoint_type,
            endpoint_count=len(endpoints),
        )

    def __str__(self) -> str:
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Service type: {self.service_type}",
                f"Service type hash: {self.service_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"Endpoint count: {self.endpoint_count}",
                *(self._two_endpoints() if self.endpoint_count == 2 else self._one_endpoint()),
            ]
        )

    def _one_endpoint(self) -> Iterator[str]:
        for gid, qos in zip(self.endpoint_gids, self.qos_profiles, strict=True):
            yield f"GID: {_hexadecimal(gid)}"
            yield "QoS profile:"
            yield from (f"  {line}" for line in _qos_lines(qos))

    def _two_endpoints(self) -> Iterator[str]:
        # Requests come first: a client writes them, a server reads them.
        order = {"Request Writer": 1, "Response Reader": 0}
        if self.endpoint_type == EndpointTypeEnum.SERVER:
            order = {"Request Reader": 0, "Response Writer": 1}
        yield "GIDs:"
        for title, index in order.items():
            yield f" - {title} : {_hexadecimal(self.endpoint_gids[index])}"
        yield "QoS profiles:"
        for title, index in order.items():
            yield f" - {title} :"
            yield from (f"      {line}" for line in _qos_lines(self.qos_profiles[index]))


def service_infos(
    graph: base.Graph, service: str, kind: EndpointTypeEnum
) -> list[ServiceEndpointInfo]:
    """Return information about each client or server of a service.

    Args:
        graph: Where they are known.
        service: The full name of the service.
        kind: ``CLIENT`` or ``SERVER``.
    """
    topics = [names.request_topic(service), names.reply_topic(service)]
    read, written = topics if kind == EndpointTypeEnum.SERVER else reversed(topics)
    readers = _by_process(graph.endpoints_of(read, "subscription"))
    writers = _by_process(graph.endpoints_of(written, "publisher"))
    # A process numbers its endpoints in the order of their creation, so its first reader belongs
    # to its first writer. Further writers are those for a second middleware. A writer may not be
    # discovered yet: then the reader stands for both.
    found = []
    for process, own_readers in readers.items():
        own_writers = iter(writers.get(process, []))
        for reader in own_readers:
            writer = next(own_writers, reader)
            found.append(ServiceEndpointInfo.from_wire(kind, reader, writer))
    return found


def _by_process(endpoints: list[base.EndpointInfo]) -> dict[bytes, list[base.EndpointInfo]]:
    found: dict[bytes, list[base.EndpointInfo]] = {}
    for endpoint in sorted(endpoints, key=lambda endpoint: endpoint.gid):
        found.setdefault(endpoint.gid[:_PROCESS_OF_GID], []).append(endpoint)
    return found


def _owner(endpoint: base.EndpointInfo) -> dict[str, Any]:
    node = endpoint.node
    return {
        "node_name": node.name if node else _UNKNOWN_NAME,
        "node_namespace": node.namespace if node else _UNKNOWN_NAMESPACE,
    }


def _hexadecimal(gid: Iterable[int]) -> str:
    return ".".join(f"{byte:02x}" for byte in gid)


def _qos_lines(qos: QoSProfile) -> list[str]:
    history = qos.history.name
    if qos.history == HistoryPolicy.KEEP_LAST:
        history += f" ({qos.depth})"
    return [
        f"Reliability: {qos.reliability.name}",
        f"History (Depth): {history}",
        f"Durability: {qos.durability.name}",
        f"Lifespan: {qos.lifespan}",
        f"Deadline: {qos.deadline}",
        f"Liveliness: {qos.liveliness.name}",
        f"Liveliness lease duration: {qos.liveliness_lease_duration}",
    ]
