"""Definitions of types as clients read them (encoding ``ros2msg``), with all types that they use.

Requests, responses and other parts of services and actions have no separate file; their text is
generated from the parsed definition.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire.msg.registry import interface_text, load_message
from turtlewire.msg.types import (
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

if TYPE_CHECKING:
    from turtlewire.msg.definition import Constant, MessageDefinition
    from turtlewire.msg.types import AbstractType

__all__ = ["ENCODING", "full_name", "schema"]

ENCODING = "ros2msg"

_SEPARATOR = "=" * 80
_BASIC = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}


def full_name(type_name: str) -> str:
    """``geometry_msgs/Twist``, as ROS 1 writes it, is ``geometry_msgs/msg/Twist``."""
    parts = type_name.split("/")
    return f"{parts[0]}/msg/{parts[1]}" if len(parts) == 2 else type_name


def schema(type_name: str) -> str:
    """Return the definition of a message, or of a part of a service or an action.

    Raises:
        InterfaceError: The type or one of those that it uses is not known.
    """
    try:
        used = _used(load_message(type_name), {type_name})
        return f"\n{_SEPARATOR}\n".join(
            [_text(type_name), *(f"MSG: {_short(name)}\n{_text(name)}" for name in used)]
        )
    except ValueError as error:  # peers other than ROS send invalid type names
        raise InterfaceError(f"'{type_name}' is not the name of a type: {error}") from error


def _used(definition: MessageDefinition, seen: set[str]) -> Iterator[str]:
    """Names of the types that a message uses, depth first, each once."""
    for field in definition.fields:
        type_ = field.type
        if isinstance(type_, AbstractNestedType):
            type_ = type_.value_type
        if isinstance(type_, NamespacedType) and type_.full_name not in seen:
            seen.add(type_.full_name)
            yield type_.full_name
            yield from _used(load_message(type_.full_name), seen)


def _text(type_name: str) -> str:
    if type_name.split("/")[1] != "msg":
        return _written(load_message(type_name))
    return interface_text(type_name)


def _written(definition: MessageDefinition) -> str:
    lines = [_constant(constant) for constant in definition.constants]
    lines += [f"{_spelled(field.type)} {field.name}" for field in definition.fields]
    return "".join(f"{line}\n" for line in lines)


def _constant(constant: Constant) -> str:
    value = constant.value
    if isinstance(value, bytes):
        value = value[0]
    elif isinstance(value, str):
        value = f'"{value}"'
    return f"{_spelled(constant.type)} {constant.name}={value}"


def _spelled(type_: AbstractType) -> str:
    """Return a type as a .msg file spells it."""
    if isinstance(type_, AbstractNestedType):
        size = ""
        if isinstance(type_, Array):
            size = f"{type_.size}"
        elif isinstance(type_, BoundedSequence):
            size = f"<={type_.maximum_size}"
        return f"{_spelled(type_.value_type)}[{size}]"
    if isinstance(type_, NamespacedType):
        return _short(type_.full_name)
    if isinstance(type_, BasicType):
        return _BASIC.get(type_.typename, type_.typename)
    assert isinstance(type_, AbstractGenericString)
    return str(type_).replace("<", "<=").rstrip(">")


def _short(type_name: str) -> str:
    package, _, name = type_name.split("/")
    return f"{package}/{name}"
