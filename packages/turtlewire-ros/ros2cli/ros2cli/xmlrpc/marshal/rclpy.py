"""Lets remote calls take and return what rclpy tells about the graph.

Importing the module enters its functions in the tables of :mod:`xmlrpc.client`.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any
from xmlrpc.client import Marshaller, Unmarshaller

from rclpy.duration import Duration
from rclpy.endpoint_info import EndpointTypeEnum, ServiceEndpointInfo, TopicEndpointInfo
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSProfile,
    QoSReliabilityPolicy,
)
from rclpy.type_hash import TypeHash
from ros2cli.xmlrpc.marshal.generic import (
    dump_any_enum,
    dump_any_with_slots,
    end_any_enum,
    end_any_with_slots,
    fullname,
)

#: The policies of which a `QoSProfile` consists.
policy_types = (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSReliabilityPolicy,
)


def dump_duration(marshaller: Any, value: Duration, write: Callable[[str], object]) -> None:  # noqa: ARG001
    """Write a `Duration`; numbers of XML-RPC have 32 bits, which are too few."""
    tag = fullname(Duration)
    write(f"<value><{tag}>{value.nanoseconds}</{tag}></value>\n")


def end_duration(unmarshaller: Any, data: str) -> None:
    """Make a `Duration`, at the end of its element."""
    unmarshaller.append(Duration(nanoseconds=int(data)))
    unmarshaller._value = 0


def end_type_hash(unmarshaller: Any, data: str) -> None:
    """Make a `TypeHash`, at the end of its element; its bytes arrive as `Binary`."""
    attributes = unmarshaller._stack[-1]
    attributes["value"] = attributes["value"].data
    end_any_with_slots(unmarshaller, data, TypeHash)


def _register() -> None:
    dumps: dict[Any, Any] = Marshaller.dispatch
    ends: dict[str, Any] = Unmarshaller.dispatch
    for enum in (*policy_types, EndpointTypeEnum):
        dumps[enum] = dump_any_enum
        ends[fullname(enum)] = functools.partial(end_any_enum, enum_=enum)
    for cls in (QoSProfile, TopicEndpointInfo, ServiceEndpointInfo, TypeHash):
        # An attribute `_depth` is the argument `depth`.
        dumps[cls] = functools.partial(dump_any_with_slots, transform=lambda name: name[1:])
        ends[fullname(cls)] = functools.partial(end_any_with_slots, type_=cls)
    ends[fullname(TypeHash)] = end_type_hash
    dumps[Duration] = dump_duration
    ends[fullname(Duration)] = end_duration


_register()
