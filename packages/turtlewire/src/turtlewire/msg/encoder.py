"""Generates the function that encodes one message type as little endian CDR (XCDR1).

Numbers that follow one another become one ``struct.pack``; nested messages are written inline,
repeated ones in a loop. While the code is generated, `_Encoder` tracks the position as far as it
is fixed: it is ``remainder`` modulo ``modulus`` (1, 2, 4 or 8), counted from the end of the four
header bytes. If that determines the padding, the padding is part of the format; otherwise a table
lookup by the length so far gives it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import gcd
from struct import Struct
from typing import TYPE_CHECKING, Any

from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    TYPE_CODES,
    AbstractNestedType,
    AbstractSequence,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import UNIT_SIZE, element_code, raw_name, units_of_text

if TYPE_CHECKING:
    from turtlewire.msg.definition import MessageDefinition
    from turtlewire.msg.types import AbstractType
    from turtlewire.msg.values import Cdr

LARGE = 1024
"""Longer sequences of numbers are not copied; ``done`` collects the parts of the result."""

HEADER = b"\x00\x01\x00\x00"
"""Encapsulation: plain CDR, little endian, no options."""

CODES = {**TYPE_CODES, "boolean": "?", "octet": "c"}
"""The ``struct`` letter of every basic type."""

SIZES = {
    "?": 1,
    "c": 1,
    "b": 1,
    "B": 1,
    "h": 2,
    "H": 2,
    "i": 4,
    "I": 4,
    "f": 4,
    "q": 8,
    "Q": 8,
    "d": 8,
}
"""Size, and alignment, of every basic type by its letter."""

# Padding before an element of alignment 2, 4, 8 by len(out) & (alignment - 1); the four header
# bytes count in len(out) but not in CDR.
_PADS = {n: tuple(bytes((4 - length) % n) for length in range(n)) for n in (2, 4, 8)}
# The same with the terminator of a string in front.
_NUL_PADS = {n: tuple(bytes(1 + (3 - length) % n) for length in range(n)) for n in (2, 4, 8)}


def make_encoder(
    cls: type, definition_of: Callable[[str], MessageDefinition] = load_message
) -> Callable[[Any], Cdr]:
    """Generate ``encode(message) -> Cdr`` for a message class.

    Args:
        cls: The class; its ``_DEFINITION`` has the fields in the order of the bytes.
        definition_of: Finds the definition of a nested message by its full name.
    """
    definition: MessageDefinition = cls._DEFINITION  # type: ignore[attr-defined]
    return _Encoder(definition_of).compile(definition)


def as_bool(value: Any) -> bool:
    """Return a bool of what equals one: 0, 1, NumPy's bools."""
    if value in (0, 1):
        return bool(value)
    raise TypeError("expected a bool")


def byte_string(values: Any) -> bytes:
    """Return the content of a sequence of ``byte``.

    A list of one-byte ``bytes``, or ``bytes`` as they are.
    """
    if isinstance(values, (bytes, bytearray)):
        return bytes(values)
    joined = b"".join(values)
    if len(joined) != len(values) or not all(values):
        raise TypeError("expected bytes of length 1")
    return joined


def array_bytes(value: Any, dtype: str, size: int) -> bytes:
    """Return the content of a fixed array of numbers."""
    if type(value) is bytes:  # it has never been read
        return value
    import numpy as np

    array = np.asarray(value, dtype=dtype)
    if array.size != size:
        raise ValueError(f"expected {size} values, got {array.size}")
    content: bytes = array.tobytes()
    return content


def swapped(values: Any) -> Any:
    """Return a sequence of numbers as little endian, on a big endian host."""
    values = values[:]
    values.byteswap()
    return values


def _has_numbers(
    definition: MessageDefinition, definition_of: Callable[[str], MessageDefinition]
) -> bool:
    """Return True if there is a sequence of numbers in it at any depth."""
    for field in definition.fields:
        type_ = field.type
        if isinstance(type_, AbstractSequence) and element_code(type_):
            return True
        nested = type_.value_type if isinstance(type_, AbstractNestedType) else type_
        if isinstance(nested, NamespacedType) and _has_numbers(
            definition_of(nested.full_name), definition_of
        ):
            return True
    return False


class _Encoder:
    """Writes the source of one encoding function."""

    def __init__(self, definition_of: Callable[[str], MessageDefinition]) -> None:
        self.definition_of = definition_of
        self.lines: list[str] = []
        self.indent = " "
        self.environment: dict[str, Any] = {
            "as_bool": as_bool,
            "byte_string": byte_string,
            "array_bytes": array_bytes,
            "swapped": swapped,
            "units_of_text": units_of_text,
            "HEADER": HEADER,
        }
        self.names = 0
        self.modulus = 8
        self.remainder = 0
        self.has_numbers = False
        self.terminator = False  # a string's NUL that the next padding brings along
        self.started = False  # whether `out` exists
        self.format = ""
        self.arguments: list[str] = []

    def compile(self, definition: MessageDefinition) -> Callable[[Any], Cdr]:
        """Generate and compile the function."""
        self.has_numbers = _has_numbers(definition, self.definition_of)
        if self.has_numbers:
            self.line("done = []; shift = 0")
        self.message(definition, "m")
        if not self.started:
            self.line(f"return {self.packed()}")
        else:
            self.flush()
            self.finish_string()
            self.line("return (*done, out) if done else out" if self.has_numbers else "return out")
        source = "def encode(m):\n" + "\n".join(self.lines)
        exec(compile(source, f"<encoder of {definition.full_name}>", "exec"), self.environment)  # noqa: S102 - our own source
        encode: Callable[[Any], Cdr] = self.environment["encode"]
        return encode

    # -- fields

    def message(self, definition: MessageDefinition, value: str) -> None:
        if not definition.fields:
            self.number("B", "0")  # ROS 2 gives an empty message one byte
        for field in definition.fields:
            self.value(field.type, f"{value}.{field.name}")

    def value(self, type_: AbstractType, value: str) -> None:
        if isinstance(type_, BasicType):
            self.basic(type_, value)
        elif isinstance(type_, NamespacedType):
            self.message(self.definition_of(type_.full_name), self.local(value))
        elif isinstance(type_, (AbstractString, AbstractWString)):
            self.text(type_, value)
        elif isinstance(type_, AbstractSequence):
            self.sequence(type_, value)
        else:
            assert isinstance(type_, Array)
            self.array(type_, value)

    def basic(self, type_: BasicType, value: str) -> None:
        code = CODES[type_.typename]
        if code == "?":
            # `struct` accepts any object as a truth value; ROS 2 only accepts 0 and 1.
            flag = self.local(value)
            value = f"{flag} if {flag} is True or {flag} is False else as_bool({flag})"
        self.number(code, value)

    def text(self, type_: AbstractString | AbstractWString, value: str) -> None:
        wide = isinstance(type_, AbstractWString)
        text = self.local(f"units_of_text({value})" if wide else f"{value}.encode()")
        if type_.has_maximum_size():
            limit = type_.maximum_size * (UNIT_SIZE if wide else 1)  # type: ignore[union-attr]
            self.line(f"if len({text}) > {limit}: raise ValueError")
        # The length of a string counts its NUL; that of a wstring counts units, without one.
        self.number("I", f"len({text}) // {UNIT_SIZE}" if wide else f"len({text}) + 1")
        self.flush()
        self.append(text)
        self.forget_down_to(4 if wide else 1)
        self.terminator = not wide

    def sequence(self, type_: AbstractSequence, value: str) -> None:
        values = self.local(value)
        if type_.has_maximum_size():
            self.line(f"if len({values}) > {type_.maximum_size}: raise ValueError")  # type: ignore[attr-defined]
        code = element_code(type_)
        if code:
            self.numbers(code, values)
        elif type_.value_type == BasicType("octet"):
            values = self.local(f"byte_string({values})")
            self.bytes(values)
        elif type_.value_type == BasicType("boolean"):
            values = self.local(f"bytes([as_bool(v) for v in {values}])")
            self.bytes(values)
        else:
            self.number("I", f"len({values})")
            self.loop(type_.value_type, values)

    def numbers(self, code: str, values: str) -> None:
        self.number("I", f"len({values})")
        self.flush()
        size = SIZES[code]
        if size == 8 and not (self.modulus == 8 and self.remainder == 0):
            self.line(f"if {values}: {self.padding(8)}")
        content = values if sys.byteorder == "little" or size == 1 else f"swapped({values})"
        self.line(f"if len({values}) <= {LARGE}: out += {content}")
        self.line(
            f"else: done += (out, {content}); shift += len(out) + len({values}) * {size}; out = "
            "bytearray()"
        )
        self.forget_down_to(min(size, 4))

    def bytes(self, values: str) -> None:
        self.number("I", f"len({values})")
        self.flush()
        self.append(values)
        self.forget_down_to(1)

    def array(self, type_: Array, value: str) -> None:
        code = element_code(type_)
        if code:
            size = SIZES[code]
            self.align(size)
            self.flush()
            dtype = f"<{'f' if code in 'fd' else 'u' if code.isupper() else 'i'}{size}"
            owner, _, name = value.rpartition(".")
            self.append(f"array_bytes({owner}.{raw_name(name)}, {dtype!r}, {type_.size})")
            self.advance(size * type_.size)
            return
        values = self.local(value)
        self.line(f"if len({values}) != {type_.size}: raise ValueError")
        if type_.value_type in (BasicType("octet"), BasicType("boolean")):
            content = (
                f"byte_string({values})"
                if type_.value_type == BasicType("octet")
                else f"bytes([as_bool(v) for v in {values}])"
            )
            self.align(1)
            self.flush()
            self.append(content)
            self.advance(type_.size)
        else:
            self.loop(type_.value_type, values)

    def loop(self, value_type: AbstractType, values: str) -> None:
        """Write the elements one by one.

        What is known about the position must hold before the first and after each of them.
        """
        self.finish_string()
        self.flush()
        item = self.name()
        self.line(f"for {item} in {values}:")
        outer_indent, self.indent = self.indent, self.indent + " "
        start = len(self.lines)
        modulus, remainder = self.modulus, self.remainder
        while True:
            del self.lines[start:]
            self.value(value_type, item)
            self.finish_string()
            self.flush()
            common = gcd(gcd(modulus, self.modulus), remainder - self.remainder)
            settled = common == modulus
            modulus, remainder = common, remainder % common
            self.modulus, self.remainder = modulus, remainder
            if settled:
                break
        self.indent = outer_indent

    # -- bytes

    def number(self, code: str, value: str) -> None:
        """Add one number to the pending format."""
        self.align(SIZES[code])
        self.format += code
        self.arguments.append(value)
        self.advance(SIZES[code])

    def align(self, size: int) -> None:
        """Pad to a multiple of ``size``."""
        if self.terminator:
            if size > 1:
                self.line(self.padding(size))
                self.modulus, self.remainder = size, 0
            else:
                self.format += "x"
            self.terminator = False
        elif size > self.modulus:
            self.flush()
            self.line(self.padding(size))
            self.modulus, self.remainder = size, 0
        else:
            missing = -self.remainder % size
            self.format += "x" * missing
            self.advance(missing)

    def padding(self, size: int) -> str:
        kind, tables = ("nul_pad", _NUL_PADS) if self.terminator else ("pad", _PADS)
        self.environment[f"{kind}{size}"] = tables[size]
        length = "len(out) + shift" if self.has_numbers else "len(out)"
        return f"out += {kind}{size}[{length} & {size - 1}]"

    def advance(self, size: int) -> None:
        self.remainder = (self.remainder + size) % self.modulus

    def forget_down_to(self, modulus: int) -> None:
        self.modulus = min(self.modulus, modulus)
        self.remainder %= self.modulus

    def finish_string(self) -> None:
        if self.terminator:
            self.line("out += b'\\0'")
            self.terminator = False

    def packed(self) -> str:
        """Expression for the pending numbers, after the header if nothing was written yet."""
        layout = self.format if self.started else f"4s{self.format}"
        arguments = self.arguments if self.started else ["HEADER", *self.arguments]
        name = self.name()
        self.environment[name] = Struct(f"<{layout}").pack
        self.format = ""
        self.arguments = []
        return f"{name}({', '.join(arguments)})"

    def flush(self) -> None:
        """Write the pending numbers."""
        if not self.started:
            self.line(f"out = bytearray({self.packed() if self.format else 'HEADER'})")
            self.started = True
        elif self.format:
            self.line(f"out += {self.packed()}")

    def append(self, value: str) -> None:
        self.line(f"out += {value}")

    # -- source

    def line(self, text: str) -> None:
        self.lines.append(self.indent + text)

    def name(self) -> str:
        self.names += 1
        return f"_{self.names}"

    def local(self, value: str) -> str:
        name = self.name()
        self.line(f"{name} = {value}")
        return name
