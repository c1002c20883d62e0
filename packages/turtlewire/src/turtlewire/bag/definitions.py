"""Definitions of message types as bags carry them: one text with all that a type needs.

The text of the type itself comes first. Each type that it uses follows once, after a line of 80
``=`` and a line ``MSG: package/Name``. Source: rosbag2 (encoding ``ros2msg``).
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire.msg.definition import MessageDefinition, ServiceDefinition
from turtlewire.msg.registry import define, interface_path, load_interface
from turtlewire.msg.types import AbstractNestedType, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtlewire.msg.registry import Definition

__all__ = ["ENCODING", "definition_text", "has_interface", "learn_types"]

ENCODING = "ros2msg"

_SEPARATOR = "=" * 80
_SPLIT = re.compile(rf"^{_SEPARATOR}\r?\n", re.MULTILINE)
_HEADING = re.compile(r"^(?:MSG|SRV): *(\S+)[^\n]*\n?")


def learn_types(type_name: str, text: str) -> None:
    """Make the types of a bag's definition known, unless they are known already.

    Args:
        type_name: ``"my_msgs/msg/Thing"``, or ``"my_msgs/srv/Do_Event"`` for a service's events.
        text: The definition with its dependencies.

    Raises:
        InterfaceError: The definition cannot be parsed.
    """
    first, *others = _SPLIT.split(text)
    heading = _HEADING.match(first)
    if heading:  # rosbag2 puts `SRV: name` before a service
        first = first[heading.end() :]
    for part in others:
        heading = _HEADING.match(part)
        if heading is None:
            raise InterfaceError(f"the definition of {type_name} has no line 'MSG: name'")
        _define(_full_name(heading[1]), part[heading.end() :])
    _define(type_name, first)


def has_interface(type_name: str) -> bool:
    """Return True if a file defines the type, installed or among ours; nothing is parsed."""
    try:
        interface_path(_owner(type_name))
    except (InterfaceError, ValueError):  # damaged bags contain invalid type names
        return False
    return True


def _define(full_name: str, text: str) -> None:
    try:
        load_interface(full_name)
    except InterfaceError:
        define(_owner(full_name), text)


def _full_name(name: str) -> str:
    """``geometry_msgs/Point`` and ``geometry_msgs/msg/Point`` name the same type."""
    package, _, rest = name.partition("/")
    return name if "/" in rest else f"{package}/msg/{rest}"


def _owner(full_name: str) -> str:
    """Return the interface that a file defines: a service for its request, response and event."""
    package, kind, name = full_name.split("/")
    return full_name if kind == "msg" else f"{package}/{kind}/{name.partition('_')[0]}"


def definition_text(type_name: str) -> str:
    """Return the definition of a type, followed by all types that it uses, for a bag.

    Raises:
        InterfaceError: The type or one of those that it uses is not known.
    """
    used = _used(load_interface(_owner(type_name)), {type_name})
    return f"\n{_SEPARATOR}\n".join(
        [
            _source(_owner(type_name)),
            *(f"MSG: {name.replace('/msg/', '/')}\n{_source(name)}" for name in used),
        ]
    )


def _source(full_name: str) -> str:
    with open(interface_path(full_name), encoding="utf-8") as file:
        return file.read()


def _used(definition: Definition, seen: set[str]) -> Iterator[str]:
    """Names of the types used by a definition, depth first, each once."""
    if isinstance(definition, ServiceDefinition):
        messages = [definition.request, definition.response]
    elif isinstance(definition, MessageDefinition):
        messages = [definition]
    else:
        messages = [definition.goal, definition.result, definition.feedback]
    for field in (field for message in messages for field in message.fields):
        type_ = field.type
        if isinstance(type_, AbstractNestedType):
            type_ = type_.value_type
        if isinstance(type_, NamespacedType):
            name = "/".join((*type_.namespaces, type_.name))
            if name not in seen:
                seen.add(name)
                yield name
                yield from _used(load_interface(name), seen)
