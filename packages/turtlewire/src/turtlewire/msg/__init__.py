"""ROS 2 interfaces without a ROS installation.

Definitions, message classes, the CDR codec and type hashes.

::

    from turtlewire import msg

    Twist = msg.get_message("geometry_msgs/msg/Twist")
    data = msg.serialize(Twist())
    twist = msg.deserialize(Twist, data)

Classes are made when they are asked for first, codecs when they are used first.

====================  =================================================================
module                what it holds
====================  =================================================================
`definition`          what an interface file says, after parsing
`types`               types of fields, named as in ROS 2's ``rosidl_parser.definition``
`parser`              texts of ``.msg``, ``.srv`` and ``.action`` files to definitions
`registry`            definitions by name, parsed at first use
`message`             `Message`, the base of all message classes
`classes`             the classes of messages, services and actions, made at first use
`constructor`         their constructors, compiled for each
`values`              defaults of fields, and bulk numbers as arrays
`checks`              ROS 2's checks at every assignment (``check_fields``)
`cdr`                 `serialize`, `deserialize` and `deserialize_rows`
`encoder`, `decoder`  generated code from messages to CDR bytes and back
`wide_text`           ``wstring`` on the wire
`diagnosis`           which field of a message or of its bytes is wrong
`type_hash`           type hashes (RIHS01)
`shell`               lazy classes of modules such as ``geometry_msgs.msg``
`idl`                 ``.idl`` files as the text of ``.msg``, ``.srv`` and ``.action`` files
`idl_reader`          reads them, for `idl` and ``rosidl_parser``
`idl_tokens`          their tokens
`generate`, `stubs`   Python packages for a folder of definitions; their ``.pyi``
`__main__`            ``python -m turtlewire.msg DIR``
====================  =================================================================
"""

from __future__ import annotations

from turtlewire.msg.cdr import deserialize, deserialize_rows, encode, serialize
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
    "deserialize_rows",
    "encode",
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
