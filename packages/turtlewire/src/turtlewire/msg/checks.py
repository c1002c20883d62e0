"""ROS 2's optional checks at every assignment.

``check_fields=True``, or ``ROS_PYTHON_CHECK_FIELDS=1`` for all messages.

Without them, fields are plain slots, and encoding the message raises the error of a wrong value. A
message with checks has its own class, derived from the plain one, whose fields are properties. The
texts are ROS 2's.
"""

from __future__ import annotations

import math
from array import array
from typing import TYPE_CHECKING, Any

from turtlewire.distro import LYRICAL, since
from turtlewire.msg.types import (
    FLOATING_POINT_TYPES,
    INTEGER_RANGES,
    AbstractGenericString,
    AbstractNestedType,
    AbstractSequence,
    AbstractType,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import element_code, numpy_name

if TYPE_CHECKING:
    from turtlewire.msg.definition import Field
    from turtlewire.msg.message import Message

_FLOAT_LIMITS = {"float": 3.402823466e38, "double": 1.7976931348623157e308}

_checked: dict[type[Message], type[Message]] = {}


def turn_on_checks(message: Message) -> None:
    """Check the fields of ``message``, and every later assignment to them.

    Raises:
        AssertionError: A field's value does not fit.
    """
    plain = type(message)
    if plain not in _checked:
        _checked[plain] = _make_checked(plain)
    message.__class__ = _checked[plain]
    for field in message._DEFINITION.fields:
        setattr(message, field.name, getattr(message, field.name))


def _make_checked(plain: type[Message]) -> type[Message]:
    namespace: dict[str, Any] = {
        "__slots__": (),
        "__module__": plain.__module__,
        "__doc__": plain.__doc__,
    }
    for field in plain._DEFINITION.fields:
        namespace[field.name] = _checking_property(field, getattr(plain, field.name))
    checked: type[Message] = type(plain.__name__, (plain,), namespace)
    checked.__slots__ = plain.__slots__
    return checked


def _checking_property(field: Field, stored: Any) -> property:
    def assign(message: Message, value: Any) -> None:
        _check(field.name, field.type, value)
        stored.__set__(message, value)

    return property(stored.__get__, assign)


def _check(name: str, type_: AbstractType, value: Any) -> None:
    if isinstance(type_, AbstractNestedType):
        _check_values(name, type_, value)
    elif isinstance(type_, NamespacedType):
        _demand(_fits(type_, value), name, f"a sub message of type '{type_.name}'")
    elif isinstance(type_, AbstractGenericString) and type_.has_maximum_size():
        limit: int = type_.maximum_size  # type: ignore[attr-defined]
        _demand(
            isinstance(value, str) and len(value) <= limit,
            name,
            f"string value not longer than {limit}",
        )
    elif type_ == BasicType("octet"):
        _demand(
            _fits(type_, value) and len(value) == 1,
            name,
            "of type 'bytes' or 'ByteString' with length 1",
        )
    else:
        _demand(_fits(type_, value), name, f"of type '{_python_name(type_)}'")
        _demand(_in_range(type_, value), name, _range_text(type_))


def _check_values(name: str, type_: AbstractNestedType, value: Any) -> None:
    if element_code(type_) and _is_native_storage(name, type_, value):
        return
    limit: int | None = getattr(type_, "maximum_size", getattr(type_, "size", None))
    wanted = "a sequence" if since(LYRICAL) else "a set or sequence"
    if limit is not None:
        wanted += (
            f" with length {limit}" if isinstance(type_, Array) else f" with length <= {limit}"
        )
    element = type_.value_type
    longest: int | None = getattr(element, "maximum_size", None)
    if longest is not None:
        wanted += f" and each string value not longer than {longest}"
    wanted += f" and each value of type '{_python_name(element)}'{_each_range_text(element)}"
    is_sequence = isinstance(value, (list, tuple, set, frozenset, range, array, bytes, bytearray))
    items: list[Any] = list(value) if is_sequence else []
    good = (
        is_sequence
        and (
            limit is None
            or (len(items) == limit if isinstance(type_, Array) else len(items) <= limit)
        )
        and all(_fits(element, item) and _in_range(element, item) for item in items)
        and (longest is None or all(len(item) <= longest for item in items))
    )
    _demand(good, name, wanted)


def _is_native_storage(name: str, type_: AbstractNestedType, value: Any) -> bool:
    """Return True if the value is the array.array or NumPy array of the field.

    An array must have the right element type and size.
    """
    if isinstance(type_, AbstractSequence) and isinstance(value, array):
        code = element_code(type_)
        if value.typecode != code:
            raise AssertionError(f"The '{name}' array.array() must have the type code of '{code}'")
        limit: int | None = getattr(type_, "maximum_size", None)
        if limit is not None and len(value) > limit:
            raise AssertionError(f"The '{name}' array.array() must have a size <= {limit}")
        return True
    if isinstance(type_, Array) and type(value).__module__ == "numpy" and hasattr(value, "dtype"):
        dtype = numpy_name(str(type_.value_type))
        if value.dtype.name != dtype:
            raise AssertionError(
                f"The '{name}' numpy.ndarray() must have the dtype of 'numpy.{dtype}'"
            )
        if value.size != type_.size:
            raise AssertionError(f"The '{name}' numpy.ndarray() must have a size of {type_.size}")
        return True
    return False


def _fits(type_: AbstractType, value: Any) -> bool:
    if isinstance(type_, NamespacedType):
        return getattr(value, "_TYPE_NAME", None) == type_.full_name
    if isinstance(type_, AbstractGenericString):
        return isinstance(value, str)
    if type_ == BasicType("octet"):
        return isinstance(value, (bytes, bytearray))
    return isinstance(value, {"bool": bool, "float": float, "int": int}[_python_name(type_)])


def _python_name(type_: AbstractType) -> str:
    if isinstance(type_, NamespacedType):
        return type_.name
    if isinstance(type_, AbstractGenericString):
        return "str"
    assert isinstance(type_, BasicType)
    special = {"boolean": "bool", "octet": "bytes"}
    return special.get(type_.typename, "float" if type_.typename in FLOATING_POINT_TYPES else "int")


def _in_range(type_: AbstractType, value: Any) -> bool:
    if not isinstance(type_, BasicType):
        return True
    if type_.typename in INTEGER_RANGES:
        low, high = INTEGER_RANGES[type_.typename]
        return bool(low <= value <= high)
    limit = _FLOAT_LIMITS.get(type_.typename)
    return limit is None or math.isinf(value) or not (value < -limit or value > limit)


def _range_text(type_: AbstractType) -> str:
    typename = str(type_)
    if typename in INTEGER_RANGES:
        low, high = INTEGER_RANGES[typename]
        return f"an {'unsigned integer' if low == 0 else 'integer'} in [{low}, {high}]"
    limit = _FLOAT_LIMITS.get(typename, 0.0)
    return f"a {typename} in [{-limit!r}, {limit!r}]"


def _each_range_text(type_: AbstractType) -> str:
    typename = str(type_) if isinstance(type_, BasicType) else ""
    if typename in INTEGER_RANGES:
        low, high = INTEGER_RANGES[typename]
        return f" and each {'unsigned integer' if low == 0 else 'integer'} in [{low}, {high}]"
    if typename in _FLOAT_LIMITS:
        limit = _FLOAT_LIMITS[typename]
        return f" and each {typename} in [{-limit:f}, {limit:f}]"
    return ""


def _demand(good: bool, name: str, wanted: str) -> None:
    if not good:
        raise AssertionError(f"The '{name}' field must be {wanted}")
