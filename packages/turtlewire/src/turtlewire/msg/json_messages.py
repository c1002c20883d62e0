"""Messages as JSON, and back.

Numbers that JSON does not have are the strings ``NaN``, ``Infinity`` and ``-Infinity``. 64-bit
integers may also be strings, because JavaScript rounds large ones; bytes may come as base64.
"""

from __future__ import annotations

import base64
import binascii
import json
import math
from typing import TYPE_CHECKING, Any

from turtlewire.errors import CdrError
from turtlewire.msg.cdr import serialize
from turtlewire.msg.classes import get_message
from turtlewire.msg.types import (
    FLOATING_POINT_TYPES,
    AbstractGenericString,
    AbstractNestedType,
    AbstractType,
    BasicType,
    NamespacedType,
)

if TYPE_CHECKING:
    from turtlewire.msg.message import Message

_SPECIAL = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
_BYTES = {"octet", "uint8"}


def cdr_from_json(type_name: str, payload: bytes) -> bytes:
    """Return the bytes of a message, from a JSON object with some or all of its fields.

    Raises:
        CdrError: ``payload`` does not match the type; the message names the field.
    """
    try:
        values = json.loads(payload)
    except (ValueError, RecursionError) as error:
        raise CdrError(f"no JSON: {error}") from error
    return serialize(message_from_values(type_name, values))


def json_from_message(message: Message) -> bytes:
    """Return a message as a JSON object with all of its fields."""
    return json.dumps(json_value(message), separators=(",", ":"), allow_nan=False).encode()


def message_from_values(type_name: str, values: Any) -> Message:
    """Return a message from a dictionary with some or all of its fields, as JSON holds them.

    Raises:
        CdrError: ``values`` does not match the type; the message names the field.
    """
    return _message(type_name, values, type_name)


def _message(type_name: str, values: Any, path: str) -> Message:
    if not isinstance(values, dict):
        raise CdrError(f"{path}: expected an object, got {_shown(values)}")
    message: Message = get_message(type_name)()
    types = {field.name: field.type for field in message._DEFINITION.fields}
    for name, value in values.items():
        if name not in types:
            raise CdrError(f"{path} has no field '{name}', it has {', '.join(types) or 'none'}")
        try:
            setattr(message, name, _value(types[name], value, f"{path}.{name}"))
        except (OverflowError, TypeError, ValueError) as error:
            if isinstance(error, CdrError):
                raise
            raise CdrError(f"{path}.{name}: {error}") from error
    return message


def _value(type_: AbstractType, value: Any, path: str) -> Any:
    if isinstance(type_, NamespacedType):
        return _message(type_.full_name, value, path)
    if isinstance(type_, AbstractNestedType):
        return _values(type_, value, path)
    if isinstance(type_, AbstractGenericString):
        if not isinstance(value, str):
            raise CdrError(f"{path}: expected a string, got {_shown(value)}")
        return value
    assert isinstance(type_, BasicType)
    return _scalar(type_.typename, value, path)


def _values(type_: AbstractNestedType, value: Any, path: str) -> Any:
    inner = type_.value_type
    if isinstance(value, str) and isinstance(inner, BasicType) and inner.typename in _BYTES:
        try:
            value = list(base64.b64decode(value, validate=True))
        except (binascii.Error, ValueError) as error:
            raise CdrError(f"{path}: invalid base64: {error}") from error
    if not isinstance(value, list):
        raise CdrError(f"{path}: expected a list, got {_shown(value)}")
    return [_value(inner, item, f"{path}[{index}]") for index, item in enumerate(value)]


def _scalar(typename: str, value: Any, path: str) -> Any:
    if typename == "boolean":
        if not isinstance(value, bool):
            raise CdrError(f"{path}: expected true or false, got {_shown(value)}")
        return value
    if typename in FLOATING_POINT_TYPES:
        if isinstance(value, str) and value in _SPECIAL:
            return _SPECIAL[value]
        if value is None or isinstance(value, bool) or not isinstance(value, int | float):
            raise CdrError(f"{path}: expected a number, got {_shown(value)}")
        return float(value)
    return _integer(typename, value, path)


def _integer(typename: str, value: Any, path: str) -> Any:
    if isinstance(value, str) and typename.endswith("64") and value.lstrip("-").isdecimal():
        value = int(value[:21])
    elif isinstance(value, float) and value.is_integer():  # JavaScript has no other numbers
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int):
        raise CdrError(f"{path}: expected an integer, got {_shown(value)}")
    if typename != "octet":
        return value
    if not 0 <= value <= 255:
        raise CdrError(f"{path}: expected a byte, got {value}")
    return bytes((value,))


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) < 60 else f"{text[:57]}..."


def json_value(value: Any) -> Any:
    """Return a value for ``json.dumps``.

    A message becomes a dictionary of its fields, and an array a list. A ``byte`` becomes a number,
    and bytes become a list of numbers. Numbers that JSON does not have become the strings ``NaN``,
    ``Infinity`` and ``-Infinity``.

    Args:
        value: A message, a field of one, or a dictionary, list or tuple of such values.
    """
    if hasattr(value, "_DEFINITION"):
        value = {field.name: getattr(value, field.name) for field in value._DEFINITION.fields}
    elif hasattr(value, "tolist"):  # array.array, and NumPy's
        value = value.tolist()
    if isinstance(value, dict):
        return {key: json_value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        # Images have millions of numbers, all integers.
        return value if set(map(type, value)) <= {int} else [json_value(item) for item in value]
    if isinstance(value, bytes):
        return value[0] if len(value) == 1 else list(value)
    if isinstance(value, float):
        return value if math.isfinite(value) else _name_of(value)
    return value


def _name_of(number: float) -> str:
    return "NaN" if math.isnan(number) else "Infinity" if number > 0 else "-Infinity"
