"""The fields of messages that name frames, such as ``frame_id`` and ``child_frame_id``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.msg.types import AbstractNestedType, AbstractString, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.msg.definition import MessageDefinition

__all__ = ["frame_fields", "rename_frames"]


def frame_fields(
    full_name: str, definition_of: Callable[[str], MessageDefinition]
) -> dict[str, Any]:
    """Return the fields of a message that name frames, at any depth.

    Args:
        full_name: The message.
        definition_of: Returns the definition of a message by its full name.

    Returns:
        Names of fields with None for a text, and with the fields in it for messages.

    Raises:
        InterfaceError: A type in the message is not known.
    """
    found: dict[str, Any] = {}
    for field in definition_of(full_name).fields:
        is_nested = isinstance(field.type, AbstractNestedType)
        inner = field.type.value_type if isinstance(field.type, AbstractNestedType) else field.type
        if isinstance(inner, NamespacedType):
            if fields := frame_fields(inner.full_name, definition_of):
                found[field.name] = fields
        elif (
            isinstance(inner, AbstractString) and not is_nested and field.name.endswith("frame_id")
        ):
            found[field.name] = None
    return found


def rename_frames(message: Any, fields: dict[str, Any], rename: Callable[[str], str]) -> bool:
    """Replace the names of frames in a message.

    Args:
        message: A message.
        fields: What `frame_fields` returned for its type.
        rename: Returns the new name of a frame, which may be the old one.

    Returns:
        True if a name has changed.
    """
    changed = False
    for name, inner in fields.items():
        value = getattr(message, name)
        if inner is None:
            new = rename(value)
            if new != value:
                setattr(message, name, new)
                changed = True
            continue
        for one in value if isinstance(value, list) else [value]:
            changed |= rename_frames(one, inner, rename)
    return changed
