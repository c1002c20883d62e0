"""ROS 2 interfaces without a ROS installation.

Definitions, message classes, the CDR codec and type hashes.

::

    from turtlewire import msg

    Twist = msg.get_message("geometry_msgs/msg/Twist")
    data = msg.serialize(Twist())
    twist = msg.deserialize(Twist, data)

Classes are created at the first access, codecs at the first use.

====================  =================================================================
module                contents
====================  =================================================================
`definition`          a parsed interface file
`types`               types of fields, named as in ROS 2's ``rosidl_parser.definition``
`parser`              parses ``.msg``, ``.srv`` and ``.action`` files
`registry`            definitions by name, parsed at first use
`bundled`             the definitions of each distribution of ROS 2
`message`             `Message`, the base of all message classes
`classes`             the classes of messages, services and actions, made at first use
`constructor`         compiles the constructors of these classes
`values`              defaults of fields, bulk numbers as arrays, and ``wstring`` on the wire
`checks`              ROS 2's checks at every assignment (``check_fields``)
`cdr`                 `serialize` and `deserialize`
`encoder`, `decoder`  generated code from messages to CDR bytes and back
`evolution`           messages with another definition than ours, such as an older one
`written_records`     messages decoded by the definitions of their writer
`json_messages`       messages as JSON, and from JSON
`diagnosis`           finds the wrong field of a message or of its bytes
`type_hash`           type hashes (RIHS01)
`shell`               lazy classes of modules such as ``geometry_msgs.msg``
`idl`                 ``.idl`` files as the text of ``.msg``, ``.srv`` and ``.action`` files
`idl_reader`          parses ``.idl`` files, for `idl` and ``rosidl_parser``
`generate`            Python packages for a folder of definitions, with their ``.pyi``
`__main__`            ``python -m turtlewire.msg DIR``
====================  =================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.msg.cdr import deserialize, serialize
from turtlewire.msg.classes import (
    Action,
    ActionImpl,
    Service,
    get_action,
    get_message,
    get_service,
    type_name,
)
from turtlewire.msg.message import Message, missing_fields
from turtlewire.msg.registry import add_package, interfaces
from turtlewire.msg.type_hash import type_hash

__all__ = [
    "Action",
    "ActionImpl",
    "Message",
    "Service",
    "add_package",
    "deserialize",
    "get_action",
    "get_message",
    "get_service",
    "interfaces",
    "missing_fields",
    "serialize",
    "type_hash",
    "type_name",
]

if not TYPE_CHECKING:  # type checkers would accept every name

    def __getattr__(name: str) -> object:
        """Raise AttributeError that says how to get the class of a message."""
        from turtlewire.msg.registry import class_advice

        raise AttributeError(f"module {__name__!r} has no attribute {name!r}{class_advice(name)}")
