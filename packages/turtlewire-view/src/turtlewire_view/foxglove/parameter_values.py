"""A parameter's value, as ROS 2 sends it and as JSON."""

from __future__ import annotations

import base64
import binascii
import math
from typing import Any

from turtlewire.msg import get_message
from turtlewire.msg.json_messages import json_value

__all__ = ["DOUBLE_TYPES", "from_json", "to_json"]

#: Numbers of ``rcl_interfaces/msg/ParameterType``, with the fields of ``ParameterValue``.
_FIELDS = {
    1: "bool_value",
    2: "integer_value",
    3: "double_value",
    4: "string_value",
    5: "byte_array_value",
    6: "bool_array_value",
    7: "integer_array_value",
    8: "double_array_value",
    9: "string_array_value",
}
_BOOL, _INTEGER, _DOUBLE, _STRING, _BYTES = 1, 2, 3, 4, 5
_ARRAY_OF = {_BOOL: 6, _INTEGER: 7, _DOUBLE: 8, _STRING: 9}
#: The types that hold floating-point numbers.
DOUBLE_TYPES = (3, 8)
_SPECIAL = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
_JSON_TYPES = {_DOUBLE: "float64", 8: "float64_array", _BYTES: "byte_array"}


def to_json(name: str, value: Any) -> dict[str, Any]:
    """Return a parameter as clients read it; one that is not set has no value.

    JSON does not distinguish 2 from 2.0, so floating-point numbers are sent with a type.

    Args:
        name: Its name.
        value: A ``rcl_interfaces/msg/ParameterValue``.
    """
    shown: dict[str, Any] = {"name": name}
    if value.type not in _FIELDS:
        return shown
    plain = getattr(value, _FIELDS[value.type])
    if value.type == _BYTES:
        plain = base64.b64encode(b"".join(plain)).decode()
    shown["value"] = json_value(plain)
    if value.type in _JSON_TYPES:
        shown["type"] = _JSON_TYPES[value.type]
    return shown


def from_json(value: Any, type_name: str | None, present_type: int) -> Any:
    """Return a ``rcl_interfaces/msg/ParameterValue`` of a client's value; None unsets a parameter.

    Args:
        value: The value.
        type_name: What the client says of its type, if it does.
        present_type: The parameter's type now, as ROS 2's number; integers are taken for
            floating-point numbers where it has such.

    Raises:
        ValueError: No parameter can have this value.
    """
    message: Any = get_message("rcl_interfaces/msg/ParameterValue")()
    if value is None:
        return message
    if type_name == "byte_array":
        number, value = _BYTES, _bytes(value)
    else:
        as_double = type_name in {"float64", "float64_array"} or (
            type_name is None and present_type in DOUBLE_TYPES
        )
        number, value = _typed(value, as_double, present_type)
    message.type = number
    try:
        setattr(message, _FIELDS[number], value)
    except (OverflowError, TypeError) as error:
        raise ValueError(str(error)) from error
    return message


def _typed(value: Any, as_double: bool, present_type: int) -> tuple[int, Any]:
    """Return the number of a value's type, and the value as Python has it."""
    if not isinstance(value, list):
        return _scalar(value, as_double)
    items = [_scalar(item, as_double) for item in value]
    kinds = {kind for kind, _ in items}
    if kinds == {_INTEGER, _DOUBLE}:
        return _ARRAY_OF[_DOUBLE], [float(item) for _, item in items]
    if len(kinds) > 1:
        raise ValueError("the items of a list are of different types")
    plain = [item for _, item in items]
    if not kinds:  # only the parameter determines the type of an empty list
        empty = present_type if present_type in _ARRAY_OF.values() else _ARRAY_OF[_STRING]
        return (_ARRAY_OF[_DOUBLE] if as_double else empty), plain
    return _ARRAY_OF[kinds.pop()], plain


def _scalar(value: Any, as_double: bool) -> tuple[int, Any]:
    if isinstance(value, bool):
        return _BOOL, value
    if as_double and isinstance(value, str) and value in _SPECIAL:
        return _DOUBLE, _SPECIAL[value]
    if isinstance(value, float) or (as_double and isinstance(value, int)):
        return _DOUBLE, float(value)
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise ValueError(f"{value} does not fit into 64 bits")
        return _INTEGER, value
    if isinstance(value, str):
        return _STRING, value
    raise ValueError("a parameter must be a bool, a number, a string or a list of them")


def _bytes(value: Any) -> list[bytes]:
    if not isinstance(value, str):
        raise ValueError("a byte array must be a string in base64")  # noqa: TRY004 - as all others
    try:
        return [bytes((byte,)) for byte in base64.b64decode(value, validate=True)]
    except binascii.Error as error:
        raise ValueError(f"a byte array is not valid base64: {error}") from error
