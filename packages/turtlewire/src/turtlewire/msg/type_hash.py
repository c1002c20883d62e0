"""Type hashes as ROS 2 computes them (RIHS01).

SHA-256 of a canonical JSON text of the type and all types in it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.msg.classes import type_name
from turtlewire.msg.definition import ActionDefinition, ServiceDefinition
from turtlewire.msg.registry import load_interface
from turtlewire.msg.types import (
    AbstractGenericString,
    AbstractNestedType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

if TYPE_CHECKING:
    from turtlewire.msg.registry import Definition
    from turtlewire.msg.types import AbstractType

_TYPE_IDS = {
    "int8": 2,
    "uint8": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float": 10,
    "double": 11,
    "boolean": 15,
    "octet": 16,
}
#: The members of services and actions in a type description, and their attributes in ours.
_PARTS = {
    ServiceDefinition: {
        "request_message": "request", "response_message": "response", "event_message": "event",
    },
    ActionDefinition: {
        "goal": "goal", "result": "result", "feedback": "feedback",
        "send_goal_service": "send_goal", "get_result_service": "get_result",
        "feedback_message": "feedback_message",
    },
}  # fmt: skip
_NESTED, _STRING, _WSTRING, _BOUNDED_STRING, _BOUNDED_WSTRING = 1, 17, 18, 21, 22
_ARRAY, _BOUNDED_SEQUENCE, _UNBOUNDED_SEQUENCE = 48, 96, 144

_descriptions: dict[str, str] = {}
_hashes: dict[str, str] = {}


def type_hash(interface: str | type) -> str:
    """Return the hash of an interface.

    Args:
        interface: Its class or its name: ``"pkg/msg/X"``, ``"pkg/srv/X"``, ``"pkg/srv/X_Request"``,
            ``"pkg/action/X"`` and so on.

    Returns:
        ``"RIHS01_"`` and 64 hexadecimal digits.

    Raises:
        InterfaceError: The interface does not exist.
    """
    full_name = interface if isinstance(interface, str) else type_name(interface)
    found = _hashes.get(full_name)
    if found is None:
        import hashlib

        others = ", ".join(_description(name) for name in referenced_types(full_name))
        described = _description(full_name)
        text = f'{{"type_description": {described}, "referenced_type_descriptions": [{others}]}}'
        found = _hashes[full_name] = f"RIHS01_{hashlib.sha256(text.encode()).hexdigest()}"
    return found


def referenced_types(full_name: str) -> list[str]:
    """Names of all types in an interface, at any depth, sorted; without itself."""
    seen: set[str] = set()
    waiting = [full_name]
    while waiting:
        for _, type_ in members(load_interface(waiting.pop())):
            nested = type_.value_type if isinstance(type_, AbstractNestedType) else type_
            if isinstance(nested, NamespacedType) and nested.full_name not in seen:
                seen.add(nested.full_name)
                waiting.append(nested.full_name)
    return sorted(seen)


def members(definition: Definition) -> list[tuple[str, AbstractType]]:
    """Names and types of what an interface consists of.

    For services and actions, the messages and services they imply.
    """
    if isinstance(definition, (ServiceDefinition, ActionDefinition)):
        return [
            (part, NamespacedType.parse(getattr(definition, name).full_name))
            for part, name in _PARTS[type(definition)].items()
        ]
    if not definition.fields:
        return [("structure_needs_at_least_one_member", BasicType("uint8"))]
    return [(field.name, field.type) for field in definition.fields]


def field_type_parts(type_: AbstractType) -> tuple[int, int, int, str]:
    """Return a type as ``type_description_interfaces/msg/FieldType`` has it.

    Type_id, capacity, string_capacity, nested_type_name.
    """
    offset, capacity = 0, 0
    if isinstance(type_, AbstractNestedType):
        if isinstance(type_, Array):
            offset, capacity = _ARRAY, type_.size
        elif isinstance(type_, BoundedSequence):
            offset, capacity = _BOUNDED_SEQUENCE, type_.maximum_size
        else:
            offset = _UNBOUNDED_SEQUENCE
        type_ = type_.value_type
    if isinstance(type_, NamespacedType):
        return offset + _NESTED, capacity, 0, type_.full_name
    if isinstance(type_, AbstractGenericString):
        wide = isinstance(type_, AbstractWString)
        limit = getattr(type_, "maximum_size", 0)
        plain, bounded = (_WSTRING, _BOUNDED_WSTRING) if wide else (_STRING, _BOUNDED_STRING)
        return offset + (bounded if limit else plain), capacity, limit, ""
    assert isinstance(type_, BasicType)
    return offset + _TYPE_IDS[type_.typename], capacity, 0, ""


def _description(full_name: str) -> str:
    found = _descriptions.get(full_name)
    if found is None:
        fields = ", ".join(
            _field_text(name, type_) for name, type_ in members(load_interface(full_name))
        )
        found = _descriptions[full_name] = f'{{"type_name": "{full_name}", "fields": [{fields}]}}'
    return found


def _field_text(name: str, type_: AbstractType) -> str:
    type_id, capacity, string_capacity, nested = field_type_parts(type_)
    return (
        f'{{"name": "{name}", "type": {{"type_id": {type_id}, "capacity": {capacity}, '
        f'"string_capacity": {string_capacity}, "nested_type_name": "{nested}"}}}}'
    )
