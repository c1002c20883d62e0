"""Publishers, subscriptions, clients and servers as plain data, for ``info --verbose --json``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rclpy.duration import Duration
    from rclpy.endpoint_info import ServiceEndpointInfo, TopicEndpointInfo
    from rclpy.qos import QoSProfile

# ROS 2's name of the node of an endpoint that no node claims.
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"


def topic_endpoint_data(info: TopicEndpointInfo) -> dict[str, Any]:
    """Return node, type, gid and QoS of a publisher or subscription."""
    return {
        "node": _node(info),
        "type": info.topic_type,
        "type_hash": _hash(info.topic_type_hash),
        **_endpoint(info.endpoint_gid, info.qos_profile),
    }


def service_endpoint_data(info: ServiceEndpointInfo) -> dict[str, Any]:
    """Return node, type and endpoints of a client or server; its reader comes before its writer."""
    endpoints = zip(info.endpoint_gids, info.qos_profiles, strict=True)
    return {
        "node": _node(info),
        "type": info.service_type,
        "type_hash": _hash(info.service_type_hash),
        "endpoints": [_endpoint(gid, qos) for gid, qos in endpoints],
    }


def _node(info: TopicEndpointInfo | ServiceEndpointInfo) -> str | None:
    if info.node_name == _UNKNOWN_NODE:
        return None
    return f"{info.node_namespace.rstrip('/')}/{info.node_name}"


def _hash(type_hash: Any) -> str | None:
    return None if type_hash.version < 0 else str(type_hash)


def _endpoint(gid: list[int], qos: QoSProfile) -> dict[str, Any]:
    return {"gid": bytes(gid).hex("."), "qos": _qos(qos)}


def _qos(qos: QoSProfile) -> dict[str, Any]:
    """Return the policies by the words of the options ``--qos-...``."""
    return {
        "reliability": qos.reliability.name.lower(),
        "history": qos.history.name.lower(),
        "depth": qos.depth if qos.history.name == "KEEP_LAST" else None,
        "durability": qos.durability.name.lower(),
        "lifespan_ns": _nanoseconds(qos.lifespan),
        "deadline_ns": _nanoseconds(qos.deadline),
        "liveliness": qos.liveliness.name.lower(),
        "liveliness_lease_duration_ns": _nanoseconds(qos.liveliness_lease_duration),
    }


def _nanoseconds(duration: Duration) -> int | None:
    from rclpy.duration import Infinite

    return None if duration == Infinite else duration.nanoseconds
