"""The option ``--json``: one JSON object per line, for programs.

docs/reference/ros2_json.md lists the keys of each verb.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.output import tell

if TYPE_CHECKING:
    from rclpy.duration import Duration
    from rclpy.endpoint_info import ServiceEndpointInfo, TopicEndpointInfo
    from rclpy.qos import QoSProfile
    from ros2cli.graph import NamesAndTypes

JSON_ARGUMENT = argument("--json", action="store_true", help="Print one JSON object per line")
# ROS 2's name of the node of an endpoint that no node claims.
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"


def print_json(data: Any) -> None:
    """Print a dictionary or a message as one line of JSON.

    Args:
        data: The values may be messages or fields of messages; see
            `turtlewire.msg.json_messages.json_value`.
    """
    import json

    from turtlewire.msg.json_messages import json_value

    line = json.dumps(json_value(data), allow_nan=False)
    # The output escapes this control character in Python's way, which is not JSON.
    print(line.replace("\x7f", "\\u007f"))


def print_json_list(rows: Sequence[Mapping[str, Any]], args: argparse.Namespace) -> None:
    """Print each row as a line, or the number of rows if the command line asks for the count."""
    for row in [{"count": len(rows)}] if args.count else rows:
        print_json(row)


def remark_printer(*, as_json: bool) -> Callable[[str], None]:
    """Return the function that prints a remark: to stdout as in ROS 2, or to stderr beside JSON."""
    return tell if as_json else print


def with_types(kind: str, found: NamesAndTypes) -> list[dict[str, Any]]:
    """Return a row for each name.

    Args:
        kind: The key of the name: ``topic``, ``service``, ``action`` or ``node``.
        found: The names and their types.
    """
    return [{kind: name, "types": types} for name, types in found]


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
