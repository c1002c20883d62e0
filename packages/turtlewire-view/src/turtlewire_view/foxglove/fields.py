"""Fields of clients' requests, checked."""

from __future__ import annotations

from typing import Any

from turtlewire_view.foxglove.protocol import ProtocolError

__all__ = ["integer", "items", "names", "required_text", "text_or_none"]

_KINDS = {dict: "objects", int: "numbers", str: "strings"}


def items(request: dict[str, Any], field: str, kind: type = dict) -> list[Any]:
    """Return a list of objects, numbers or strings.

    Raises:
        ProtocolError: The field is not such a list.
    """
    value = request.get(field)
    if not isinstance(value, list) or not all(type(item) is kind for item in value):
        raise ProtocolError(f'"{field}" must be a list of {_KINDS[kind]}')
    return value


def names(request: dict[str, Any]) -> list[str]:
    """Return the names of parameters; a missing field means none.

    Raises:
        ProtocolError: The field is not a list of strings.
    """
    return items({"parameterNames": [], **request}, "parameterNames", str)


def integer(item: dict[str, Any], field: str) -> int:
    """Return a number that fits into 32 bits without a sign.

    Raises:
        ProtocolError: The field is not such a number.
    """
    value = item.get(field)
    if type(value) is not int or not 0 <= value < 1 << 32:
        raise ProtocolError(f'"{field}" must be an integer from 0 to 4294967295')
    return value


def required_text(item: dict[str, Any], field: str) -> str:
    """Return a string.

    Raises:
        ProtocolError: The field is missing or not a string.
    """
    value = text_or_none(item, field)
    if value is None:
        raise ProtocolError(f'"{field}" is missing')
    return value


def text_or_none(item: dict[str, Any], field: str) -> str | None:
    """Return a string, or None if there is no such field.

    Raises:
        ProtocolError: The field is something else.
    """
    value = item.get(field)
    if value is not None and not isinstance(value, str):
        raise ProtocolError(f'"{field}" must be a string')
    return value
