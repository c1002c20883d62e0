"""What is known of a publisher or subscription of the graph."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any

from .qos import HistoryPolicy, QoSProfile, qos_profile_unknown
from .type_hash import TypeHash

if TYPE_CHECKING:
    from turtlewire.wire import base

__all__ = ["TopicEndpointInfo", "TopicEndpointTypeEnum"]


class TopicEndpointTypeEnum(IntEnum):
    """Which end of a topic it is."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


class TopicEndpointInfo:
    """One end of a topic.

    Attributes:
        node_name: Name of the node that owns it.
        node_namespace: Namespace of that node.
        topic_type: For example ``geometry_msgs/msg/Twist``.
        topic_type_hash: Hash of the type's definition.
        endpoint_type: Publisher or subscription.
        endpoint_gid: 16 numbers that identify it.
        qos_profile: As it was announced.
    """

    __slots__ = (
        "endpoint_gid",
        "endpoint_type",
        "node_name",
        "node_namespace",
        "qos_profile",
        "topic_type",
        "topic_type_hash",
    )
    __hash__ = None  # type: ignore[assignment]  # mutable

    def __init__(self, **kwargs: Any) -> None:
        unknown = set(kwargs) - set(self.__slots__)
        if unknown:
            raise AssertionError(f"Invalid arguments passed to constructor: {sorted(unknown)}")
        self.node_name: str = kwargs.get("node_name", "")
        self.node_namespace: str = kwargs.get("node_namespace", "")
        self.topic_type: str = kwargs.get("topic_type", "")
        self.topic_type_hash: TypeHash = kwargs.get("topic_type_hash", TypeHash())
        self.endpoint_type: TopicEndpointTypeEnum = TopicEndpointTypeEnum(
            kwargs.get("endpoint_type", TopicEndpointTypeEnum.INVALID)
        )
        self.endpoint_gid: list[int] = kwargs.get("endpoint_gid", [])
        self.qos_profile: QoSProfile = kwargs.get("qos_profile", qos_profile_unknown)

    @classmethod
    def from_wire(cls, endpoint: base.EndpointInfo) -> TopicEndpointInfo:
        """Convert from what the middleware reports.

        An endpoint that no node claims gets ROS 2's names for that.
        """
        node = endpoint.node
        return cls(
            node_name=node.name if node else "_NODE_NAME_UNKNOWN_",
            node_namespace=node.namespace if node else "_NODE_NAMESPACE_UNKNOWN_",
            topic_type=endpoint.type_name,
            topic_type_hash=TypeHash.from_string(endpoint.type_hash),
            endpoint_type=TopicEndpointTypeEnum[endpoint.kind.upper()],
            endpoint_gid=list(endpoint.gid),
            qos_profile=QoSProfile.from_wire(endpoint.qos),
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TopicEndpointInfo):
            return NotImplemented
        return all(getattr(self, field) == getattr(other, field) for field in self.__slots__)

    def __str__(self) -> str:
        qos = self.qos_profile
        history = (
            qos.history.name
            if qos.history != HistoryPolicy.KEEP_LAST
            else f"{qos.history.name} ({qos.depth})"
        )
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Topic type: {self.topic_type}",
                f"Topic type hash: {self.topic_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"GID: {'.'.join(f'{byte:02x}' for byte in self.endpoint_gid)}",
                "QoS profile:",
                f"  Reliability: {qos.reliability.name}",
                f"  History (Depth): {history}",
                f"  Durability: {qos.durability.name}",
                f"  Lifespan: {qos.lifespan}",
                f"  Deadline: {qos.deadline}",
                f"  Liveliness: {qos.liveliness.name}",
                f"  Liveliness lease duration: {qos.liveliness_lease_duration}",
            ]
        )
