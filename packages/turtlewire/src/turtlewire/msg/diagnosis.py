"""Explains why bytes cannot be decoded, or a message cannot be encoded.

The generated codecs only notice that something is wrong. The readers here walk the definition field
by field, slowly, until they find the error.
"""

from __future__ import annotations

from struct import Struct, error
from typing import TYPE_CHECKING, Any

from turtlewire.errors import CdrError
from turtlewire.msg.encoder import CODES, SIZES, as_bool
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    FLOATING_POINT_TYPES,
    INTEGER_RANGES,
    AbstractGenericString,
    AbstractNestedType,
    AbstractString,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import UNIT_SIZE, text_of_units, units_of_text
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.msg.definition import MessageDefinition
    from turtlewire.msg.types import AbstractType


def check_bytes(definition: MessageDefinition, data: bytes, order: str) -> None:
    """Walk through encoded bytes.

    Raises:
        CdrError: The bytes are malformed; names type, field and offset.
    """
    _ByteWalk(definition.full_name, data, order).message(definition, "")


def check_message(definition: MessageDefinition, message: Any) -> None:
    """Walk through a message's values.

    Raises:
        CdrError: A value does not fit its field; names type, field, what was expected and what was
            found.
    """
    _ValueWalk(definition.full_name).message(definition, message, "")


class _ByteWalk:
    """One pass over encoded bytes."""

    def __init__(self, full_name: str, data: bytes, order: str) -> None:
        self.full_name = full_name
        self.data = data
        self.order = order
        self.offset = 4

    def message(self, definition: MessageDefinition, path: str) -> None:
        if not definition.fields:
            self.take(1, 1, path or "(the byte of an empty message)")
        for field in definition.fields:
            self.value(field.type, f"{path}.{field.name}" if path else field.name)

    def value(self, type_: AbstractType, path: str) -> None:
        if isinstance(type_, BasicType):
            size = SIZES[CODES[type_.typename]]
            self.take(size, size, path)
        elif isinstance(type_, NamespacedType):
            self.message(load_message(type_.full_name), path)
        elif isinstance(type_, AbstractGenericString):
            self.text(type_, path)
        else:
            assert isinstance(type_, AbstractNestedType)
            count = type_.size if isinstance(type_, Array) else self.length(type_, path)
            self.values(type_.value_type, count, path)

    def values(self, value_type: AbstractType, count: int, path: str) -> None:
        if isinstance(value_type, BasicType):
            size = SIZES[CODES[value_type.typename]]
            if count:
                self.take(size * count, size, path)
            return
        for index in range(count):
            self.value(value_type, f"{path}[{index}]")

    def text(self, type_: AbstractGenericString, path: str) -> None:
        narrow = isinstance(type_, AbstractString)
        size = self.length(type_, path, extra=int(narrow))
        start = self.offset
        content = self.take(size if narrow else size * UNIT_SIZE, 1, path)
        if narrow and content:
            if content[-1]:
                raise self.fault(path, start, "a string without its terminating zero byte")
            content = content[:-1]
        try:
            content.decode() if narrow else text_of_units(content, self.order)
        except UnicodeDecodeError as fault:
            raise self.fault(
                path,
                start,
                f"a string that is not valid {'UTF-8' if narrow else 'UTF-16'} ({fault.reason})",
            ) from None

    def length(self, type_: AbstractType, path: str, extra: int = 0) -> int:
        (length,) = Struct(f"{self.order}I").unpack(self.take(4, 4, path))
        limit = getattr(type_, "maximum_size", None)
        if limit is not None and length > limit + extra:
            raise self.fault(
                path,
                self.offset - 4,
                f"a length of {length - extra}, but {type_} holds at most {limit}",
            )
        return int(length)

    def take(self, size: int, alignment: int, path: str) -> bytes:
        start = self.offset + (4 - self.offset) % alignment
        if start + size > len(self.data):
            text = f"needs {counted(size, 'byte')}, but the data ends after {len(self.data)}"
            raise self.fault(path, start, text)
        self.offset = start + size
        return self.data[start : self.offset]

    def fault(self, path: str, offset: int, text: str) -> CdrError:
        return CdrError(f"{self.full_name}: field '{path}' at offset {offset}: {text}")


class _ValueWalk:
    """One pass over the values of a message."""

    def __init__(self, full_name: str) -> None:
        self.full_name = full_name

    def message(self, definition: MessageDefinition, message: Any, path: str) -> None:
        found = getattr(message, "_TYPE_NAME", None)
        if found != definition.full_name:
            raise self.fault(path, definition.full_name, message).with_hint(_conversion(message))
        for field in definition.fields:
            field_path = f"{path}.{field.name}" if path else field.name
            if not hasattr(message, field.name):
                raise CdrError(f"{self.full_name}: field '{field_path}' was deleted")
            self.value(field.type, getattr(message, field.name), field_path)

    def value(self, type_: AbstractType, value: Any, path: str) -> None:
        if isinstance(type_, BasicType):
            self.basic(type_, value, path)
        elif isinstance(type_, NamespacedType):
            self.message(load_message(type_.full_name), value, path)
        elif isinstance(type_, AbstractGenericString):
            self.text(type_, value, path)
        else:
            assert isinstance(type_, AbstractNestedType)
            self.values(type_, value, path)

    def basic(self, type_: BasicType, value: Any, path: str) -> None:
        expected = {"boolean": "bool", "octet": "bytes of length 1"}.get(
            type_.typename, type_.typename
        )
        if type_.typename in INTEGER_RANGES:
            low, high = INTEGER_RANGES[type_.typename]
            expected = f"an integer from {low} to {high}"
        elif type_.typename in FLOATING_POINT_TYPES:
            expected = "a float" if type_.typename == "double" else "a float that fits 32 bits"
        try:
            if type_.typename == "boolean":
                as_bool(value)
            else:
                Struct(f"<{CODES[type_.typename]}").pack(value)
        except (error, TypeError, ValueError, OverflowError):
            raise self.fault(path, expected, value) from None

    def text(self, type_: AbstractGenericString, value: Any, path: str) -> None:
        if not isinstance(value, str):
            raise self.fault(path, "str", value)
        narrow = isinstance(type_, AbstractString)
        try:
            size = len(value.encode()) if narrow else len(units_of_text(value)) // UNIT_SIZE
        except UnicodeEncodeError:
            raise self.fault(path, "str that can be encoded (no lone surrogates)", value) from None
        limit = getattr(type_, "maximum_size", None)
        if limit is not None and size > limit:
            raise self.fault(
                path,
                f"at most {limit} {'bytes of UTF-8' if narrow else 'UTF-16 code units'}",
                value,
            )

    def values(self, type_: AbstractNestedType, value: Any, path: str) -> None:
        try:
            count = len(value)
            items = list(value.flat) if hasattr(value, "flat") else list(value)
        except TypeError:
            raise self.fault(path, f"a sequence ({type_})", value) from None
        if isinstance(type_, Array) and len(items) != type_.size:
            raise CdrError(
                f"{self.full_name}: field '{path}': expected {type_.size} values, got {len(items)}"
            )
        limit = getattr(type_, "maximum_size", count)
        if count > limit:
            raise CdrError(
                f"{self.full_name}: field '{path}': expected at most {limit} values, got {count}"
            )
        if type_.value_type == BasicType("octet") and isinstance(value, (bytes, bytearray)):
            return
        for index, item in enumerate(items):
            self.value(type_.value_type, item, f"{path}[{index}]")

    def fault(self, path: str, expected: str, value: Any) -> CdrError:
        shown = repr(value)
        shown = shown if len(shown) <= 80 else f"{shown[:77]}..."
        where = f"field '{path}'" if path else "the message"
        return CdrError(
            f"{self.full_name}: {where}: expected {expected}, got {type(value).__name__} ({shown})"
        )


def _conversion(value: Any) -> str:
    """Return a hint for objects that convert to a message, such as rclpy's Time and Duration."""
    if not hasattr(value, "to_msg"):
        return ""
    return f"A {type(value).__name__} is not a message; its to_msg() returns one."
