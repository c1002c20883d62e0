"""ROS 2 interfaces without a ROS installation.

Definitions, message classes, the CDR codec and type hashes.

::

    from turtlewire import msg

    Twist = msg.get_message("geometry_msgs/msg/Twist")
    data = msg.serialize(Twist())
    twist = msg.deserialize(Twist, data)

Classes are made when they are asked for first, codecs when they are used first.
"""

from __future__ import annotations

from turtlewire.msg.cdr import deserialize, serialize
from turtlewire.msg.classes import (
    Action,
    Service,
    get_action,
    get_interface_class,
    get_message,
    get_service,
    type_name,
)
from turtlewire.msg.message import Message
from turtlewire.msg.registry import interface_names, interface_path, register_package
from turtlewire.msg.shell import lazy_classes
from turtlewire.msg.type_hash import type_hash

__all__ = [
    "Action",
    "Message",
    "Service",
    "deserialize",
    "get_action",
    "get_interface_class",
    "get_message",
    "get_service",
    "interface_names",
    "interface_path",
    "lazy_classes",
    "register_package",
    "serialize",
    "type_hash",
    "type_name",
]
