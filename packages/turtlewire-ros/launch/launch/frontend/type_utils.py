"""Converts the text of attributes to values of a type."""

from __future__ import annotations

import typing
from typing import Any

from launch.frontend.entity import Entity

_TRUE = ("yes", "true", "on")
_FALSE = ("no", "false", "off")
_SCALARS: dict[str, Any] = {"str": str, "int": int, "float": float, "bool": bool}
_TYPES = _SCALARS | {
    f"list_of_{name}": list[kind]  # type: ignore[valid-type]
    for name, kind in _SCALARS.items()
}


def list_item_type(data_type: Any) -> Any:
    """Return the item type of a list type; None for other types."""
    return (
        typing.get_args(data_type)[0]
        if typing.get_origin(data_type) is list and typing.get_args(data_type)
        else None
    )


def check_is_list_entity(data_type: Any) -> bool:
    """Return True if child elements are meant."""
    item = list_item_type(data_type)
    return isinstance(item, type) and issubclass(item, Entity)


def get_data_type_from_identifier(type_identifier: str) -> Any:
    """Return the type that the attribute ``type`` of an element names.

    Args:
        type_identifier: ``int``, ``list_of_str`` and so on.

    Raises:
        RuntimeError: No type has this name.
    """
    if type_identifier not in _TYPES:
        raise RuntimeError(
            f"unknown type '{type_identifier}' of a parameter; one of: {', '.join(_TYPES)}"
        )
    return _TYPES[type_identifier]


def coerce(text: str, data_type: Any) -> Any:
    """Return the value that a text means.

    Args:
        text: The text.
        data_type: ``int``, ``float``, ``bool``, ``str``, or None for what YAML makes of it.

    Raises:
        ValueError: ``text`` is not a value of the type.
    """
    if data_type is str:
        return text
    if data_type is bool:
        lowered = text.strip().lower()
        if lowered in _TRUE or lowered in _FALSE:
            return lowered in _TRUE
        raise ValueError(f"Expected one of '{'|'.join(_TRUE + _FALSE)}', got '{text}'")
    if data_type in (int, float):
        return data_type(text)
    import yaml

    value = yaml.safe_load(text)
    return "" if value is None else value  # an empty string and YAML's null are one


def may_become(text: str, data_type: Any) -> bool:
    """Return True if a text may have a value of a type once its substitutions are performed.

    Args:
        text: The text as it is in the launch file.
        data_type: The type. Only ``bool`` is checked here; other types are when they are used.
    """
    if data_type is not bool or "$(" in text:
        return True
    # Conditions also accept digits.
    return text.strip().lower() in (*_TRUE, *_FALSE, "1", "0")
