"""Definitions of message types in the format of bags: one text with all types that one needs.

The text of the type itself comes first. Each type that it uses follows once, after a line of 80
``=`` and a line ``MSG: package/Name``. Source: rosbag2 (encoding ``ros2msg``). If only .idl files
define a type, rosbag2 writes these, with lines ``IDL: package/msg/Name`` (``ros2idl``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from turtlewire.bag.metadata import full_type_name
from turtlewire.errors import InterfaceError
from turtlewire.msg import type_hash
from turtlewire.msg.definition import MessageDefinition, ServiceDefinition, nested_types
from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.parser import parse_message
from turtlewire.msg.registry import (
    define,
    interface_path,
    interface_text,
    load_interface,
    load_message,
)

if TYPE_CHECKING:
    from turtlewire.msg.registry import Definition

__all__ = [
    "ENCODING",
    "definition_text",
    "has_interface",
    "in_ros2msg",
    "known_hash",
    "learn_types",
    "parse_definition",
]

ENCODING = "ros2msg"

_SEPARATOR = "=" * 80
_SPLIT = re.compile(rf"^{_SEPARATOR}\r?\n", re.MULTILINE)
#: Texts of the types that only bags define.
_learned: dict[str, str] = {}

_HEADING = re.compile(r"^(?:MSG|SRV|IDL): *(\S+)[^\n]*\n?")


def in_ros2msg(type_name: str, encoding: str, text: str) -> tuple[str, str]:
    """Translate a definition from ``ros2idl`` to ``ros2msg``.

    Returns:
        Its encoding and text. A definition in another encoding, or one that cannot be translated,
        is returned unchanged.
    """
    if encoding != "ros2idl":
        return encoding, text
    try:
        parts = dict(_parts(type_name, text))
        first = idl_to_text(type_name, parts.pop(type_name))
        others = [f"MSG: {name}\n{idl_to_text(name, part)}" for name, part in parts.items()]
    except InterfaceError:
        return encoding, text
    return ENCODING, f"\n{_SEPARATOR}\n".join([first, *others])


def parse_definition(type_name: str, text: str) -> dict[str, MessageDefinition]:
    """Return the messages of a bag's definition by full name, the type's own among them.

    Raises:
        InterfaceError: The definition cannot be parsed, a type in it is not known, or a message
            contains itself.
    """
    found = {
        name: parse_message(name, part, strict=False)
        for name, part in _parts(type_name, text)
        if "/msg/" in name
    }
    if type_name in found:
        _check(type_name, found, set(), ())
    return found


def _check(
    name: str, found: dict[str, MessageDefinition], checked: set[str], outer: tuple[str, ...]
) -> None:
    """Refuse a message with an unknown type, or one that contains itself."""
    if name in outer:
        raise InterfaceError(f"{name} contains itself")
    if name in checked:
        return
    definition = found.get(name) or load_message(name)
    for inner in nested_types(definition):
        _check(inner, found, checked, (*outer, name))
    checked.add(name)


def learn_types(type_name: str, text: str) -> None:
    """Make the types of a bag's definition known, unless they are known already.

    Args:
        type_name: ``"my_msgs/msg/Thing"``, or ``"my_msgs/srv/Do_Event"`` for a service's events.
        text: The definition with its dependencies.

    Raises:
        InterfaceError: The definition cannot be parsed.
    """
    if "/msg/" in type_name:
        parse_definition(type_name, text)
    for name, part in reversed(_parts(type_name, text)):
        try:
            load_interface(name)
        except InterfaceError:  # noqa: PERF203 - few types, once
            define(_owner(name), part, strict=False)
            _learned[_owner(name)] = part


def _parts(type_name: str, text: str) -> list[tuple[str, str]]:
    """Return names and texts of the type and of those that it uses."""
    first, *others = _SPLIT.split(text)
    if not first and others:  # in `ros2idl`, the type itself has a heading, too
        first, *others = others
    heading = _HEADING.match(first)
    if heading:  # rosbag2 puts `SRV: name` before a service
        first = first[heading.end() :]
    parts = [(type_name, first)]
    for part in others:
        heading = _HEADING.match(part)
        if heading is None:
            raise InterfaceError(f"the definition of {type_name} has no line 'MSG: name'")
        parts.append((full_type_name(heading[1]), part[heading.end() :]))
    for name, _ in parts:
        if name.count("/") != 2:
            raise InterfaceError(f"'{name}' is not the name of an interface")
    return parts


def has_interface(type_name: str) -> bool:
    """Return True if a file defines the type, installed or among ours; nothing is parsed."""
    try:
        interface_path(_owner(type_name))
    except (InterfaceError, ValueError):  # damaged bags contain invalid type names
        return False
    return True


def known_hash(type_name: str) -> str:
    """Return the hash of a type; empty if the type is not known."""
    try:
        return type_hash(type_name)
    except InterfaceError:
        return ""


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
    if full_name in _learned:
        return _learned[full_name]
    return interface_text(full_name)


def _used(definition: Definition, seen: set[str]) -> Iterator[str]:
    """Names of the types used by a definition, depth first, each once."""
    if isinstance(definition, ServiceDefinition):
        messages = [definition.request, definition.response]
    elif isinstance(definition, MessageDefinition):
        messages = [definition]
    else:
        messages = [definition.goal, definition.result, definition.feedback]
    for name in (name for message in messages for name in nested_types(message)):
        if name not in seen:
            seen.add(name)
            yield name
            yield from _used(load_interface(name), seen)
