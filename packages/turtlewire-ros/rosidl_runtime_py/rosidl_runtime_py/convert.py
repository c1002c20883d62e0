"""Messages as YAML, as CSV and as ordered dictionaries, with the texts of ROS 2."""

from __future__ import annotations

import sys
from array import array
from collections import OrderedDict
from typing import TYPE_CHECKING, Any

from turtlewire.msg.types import AbstractNestedType, Array, BoundedSequence, NamespacedType

if TYPE_CHECKING:
    from turtlewire.msg import Message
    from turtlewire.msg.types import AbstractType

_ELLIPSIS = "..."


def get_message_slot_types(msg: Message) -> OrderedDict[str, AbstractType]:
    """Return the names and types of a message's fields, in order."""
    return OrderedDict(zip(msg.get_fields_and_field_types(), msg.SLOT_TYPES, strict=True))


def message_to_yaml(
    msg: Message,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """Return a message as YAML.

    Args:
        msg: The message.
        truncate_length: Largest number of elements of a sequence and characters of a string,
            then ``...``.
        no_arr: Show type and length of sequences and arrays in their place.
        no_str: Show the length of strings in their place.
        flow_style: Write sequences on one line, ``[1, 2]``.

    Returns:
        The YAML text, ending in a newline.
    """
    import yaml

    # A new class for each call, because `add_representer` changes it.
    class Dumper(yaml.Dumper):
        """Writes mappings in the order they have, always in block style."""

    def represent_mapping(dumper: yaml.Dumper, data: OrderedDict[str, Any]) -> yaml.MappingNode:
        items = [
            (dumper.represent_data(key), dumper.represent_data(value))
            for key, value in data.items()
        ]
        return yaml.MappingNode("tag:yaml.org,2002:map", items)

    Dumper.add_representer(OrderedDict, represent_mapping)
    text: str = yaml.dump(
        message_to_ordereddict(msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str),
        Dumper=Dumper,
        allow_unicode=True,
        # YAML would wrap long texts.
        width=sys.maxsize,
        default_flow_style=flow_style,
    )
    return text


def message_to_ordereddict(
    msg: Message, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> OrderedDict[str, Any]:
    """Return a message as an ordered dictionary of plain Python values.

    See `message_to_yaml` for the arguments.
    """

    def convert(value: Any, type_: AbstractType | None) -> Any:
        if hasattr(value, "SLOT_TYPES"):
            return message_to_ordereddict(
                value, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str
            )
        if isinstance(value, bytes):
            # As ROS 2 shows `byte`: one character of the same number.
            return _shortened(value.decode("latin-1"), truncate_length)
        if isinstance(value, str):
            return (
                f"<string length: <{len(value)}>>" if no_str else _shortened(value, truncate_length)
            )
        if _is_sequence(value):
            if no_arr and type_ is not None:
                return _abbreviation(value, type_)
            # Without a type: elements are never sequences themselves.
            shown = [convert(item, None) for item in value[:truncate_length]]
            return [*shown, _ELLIPSIS] if len(shown) < len(value) else shown
        # NumPy's numbers, which YAML would write as objects of Python.
        return value.item() if hasattr(value, "item") else value

    return OrderedDict(
        (name, convert(getattr(msg, name), type_))
        for name, type_ in get_message_slot_types(msg).items()
    )


def message_to_csv(
    msg: Message, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> str:
    """Return a message as comma-separated values, nested ones flattened.

    See `message_to_yaml` for the arguments.
    """

    def convert(value: Any, type_: AbstractType | None) -> str:
        if hasattr(value, "SLOT_TYPES"):
            return message_to_csv(
                value, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str
            )
        if _is_sequence(value):
            if no_arr and type_ is not None:
                return _abbreviation(value, type_)
            shown = [convert(item, None) for item in value[:truncate_length]]
            return ",".join([*shown, _ELLIPSIS] if len(shown) < len(value) else shown)
        if isinstance(value, (str, bytes)) and no_str:
            return f"<string length: <{len(value)}>>"
        if isinstance(value, bytes):
            return str(
                value
                if truncate_length is None or len(value) <= truncate_length
                else value[:truncate_length] + b"..."
            )
        return _shortened(str(value), truncate_length) if isinstance(value, str) else str(value)

    return ",".join(
        convert(getattr(msg, name), type_) for name, type_ in get_message_slot_types(msg).items()
    )


def _is_sequence(value: Any) -> bool:
    return isinstance(value, (list, tuple, array)) or getattr(value, "ndim", 0) > 0


def _shortened(text: str, length: int | None) -> str:
    return text if length is None or len(text) <= length else text[:length] + _ELLIPSIS


def _abbreviation(value: Any, type_: AbstractType) -> str:
    assert isinstance(type_, AbstractNestedType)
    element = type_.value_type
    name = (
        element.full_name if isinstance(element, NamespacedType) else str(element).partition("<")[0]
    )
    if isinstance(type_, Array):
        return f"<array type: {name}[{type_.size}]>"
    limit = f"[{type_.maximum_size}]" if isinstance(type_, BoundedSequence) else ""
    return f"<sequence type: {name}{limit}, length: {len(value)}>"
