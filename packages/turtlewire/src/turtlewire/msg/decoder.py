"""Generates the function that decodes one message type from CDR, little or big endian.

The generated code reads numbers that follow one another with one ``struct.unpack_from``. Every
malformed input makes one of its operations raise; ``turtlewire.msg.diagnosis`` then finds the field
that is wrong. As in the encoder, ``modulus`` and ``remainder`` say what is
known about the position, counted from the end of the four header bytes.
"""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable
from math import gcd
from struct import Struct
from typing import TYPE_CHECKING, Any

from turtlewire.msg.encoder import CODES, SIZES
from turtlewire.msg.types import (
    AbstractSequence,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import UNIT_SIZE, element_code, numpy_name, raw_name, text_of_units

if TYPE_CHECKING:
    from turtlewire.msg.definition import MessageDefinition
    from turtlewire.msg.message import Message
    from turtlewire.msg.types import AbstractType


def make_decoder(
    cls: type[Message],
    order: str,
    class_of: Callable[[str], type[Message]],
    *,
    rows: bool = False,
    exact: bool = False,
) -> Callable[[bytes], Message]:
    """Generate ``decode(data) -> message`` for a message class.

    Args:
        cls: The class.
        order: ``"<"`` for little endian data, ``">"`` for big endian.
        class_of: Finds the class of a nested message by its full name.
        rows: Whether sequences of plain messages become arrays of NumPy, which share the memory
            of ``data`` (see :func:`turtlewire.msg.deserialize`).
        exact: Whether more bytes after the message than padding are an error.
    """
    return Decoder(order, class_of, rows=rows, exact=exact).compile(cls)


def numbers(code: str, data: memoryview, swap: bool) -> array[Any]:
    """Return a sequence of numbers from its bytes."""
    values = array(code)
    values.frombytes(data)
    if swap:
        values.byteswap()
    return values


class Decoder:
    """Writes the source of one decoding function.

    ``self.base + self.offset`` is the position in ``data``.
    """

    #: What a message without fields consists of.
    no_fields_code = "B"

    def __init__(
        self,
        order: str,
        class_of: Callable[[str], type[Message]],
        *,
        rows: bool = False,
        exact: bool = False,
    ) -> None:
        self.class_of = class_of
        self.exact = exact
        self.rows = rows
        self.order = order
        self.lines: list[str] = []
        self.indent = " "
        self.environment: dict[str, Any] = {
            "new": object.__new__,
            "numbers": numbers,
            "text_of_units": text_of_units,
        }
        self.names = 0
        self.modulus = 8
        self.remainder = 0
        self.base = ""
        self.offset = 4
        self.format = ""
        self.targets: list[str] = []

    def compile(self, cls: type[Message]) -> Callable[[bytes], Message]:
        """Generate and compile the function."""
        self.message(cls, "m")
        self.flush()
        self.finish()
        self.line("return m")
        source = "def decode(data):\n" + "\n".join(self.lines)
        exec(compile(source, f"<decoder of {cls._TYPE_NAME}>", "exec"), self.environment)  # noqa: S102 - our own source
        decode: Callable[[bytes], Message] = self.environment["decode"]
        return decode

    def finish(self) -> None:
        """Refuse bytes after the last field."""
        if self.exact:
            self.line(f"rest = len(data) - ({self.position()})")
            self.line("if rest and (rest > 3 or len(data) % 4): raise ValueError('it is longer')")

    # -- fields

    def message(self, cls: type[Message], target: str) -> None:
        class_name = self.name()
        self.environment[class_name] = cls
        self.line(f"{target} = new({class_name})")
        definition: MessageDefinition = cls._DEFINITION
        if not definition.fields and self.no_fields_code:
            self.number(self.no_fields_code, "_")
        for field in definition.fields:
            self.value(field.type, f"{target}.{field.name}")

    def value(self, type_: AbstractType, target: str) -> None:
        if isinstance(type_, BasicType):
            self.number(CODES[type_.typename], target)
        elif isinstance(type_, NamespacedType):
            nested = self.name()
            self.message(self.class_of(type_.full_name), nested)
            self.line(f"{target} = {nested}")
        elif isinstance(type_, AbstractString):
            self.text(type_, target)
        elif isinstance(type_, AbstractWString):
            self.wide_text(type_, target)
        elif isinstance(type_, AbstractSequence):
            self.sequence(type_, target)
        else:
            assert isinstance(type_, Array)
            self.array(type_, target)

    def text(self, type_: AbstractString, target: str) -> None:
        size = self.length(type_, extra=1)
        self.line(f"end = {self.position()} + {size}")
        # The terminator: IndexError beyond the data. A size of 0 (some writers' empty string) meets
        # a zero byte of the size itself.
        self.line("if data[end - 1]: raise ValueError")
        self.line(f"{target} = data[{self.position()}:end - 1].decode()")
        self.jump("end", 1)

    def wide_text(self, type_: AbstractWString, target: str) -> None:
        size = self.length(type_)
        self.bounded_end(f"{size} * {UNIT_SIZE}")
        self.line(f"{target} = text_of_units(data[{self.position()}:end], {self.order!r})")
        self.jump("end", 4)

    def sequence(self, type_: AbstractSequence, target: str) -> None:
        count = self.length(type_)
        code = element_code(type_)
        if code:
            self.number_sequence(code, count, target)
        elif type_.value_type in (BasicType("octet"), BasicType("boolean")):
            self.small_values(type_.value_type, count, target)
        elif self.rows and len(set(codes := self.plain_codes(type_.value_type))) == 1:
            self.row_sequence(codes, count, target)
        else:
            self.loop(type_.value_type, count, target)

    def plain_codes(self, type_: AbstractType) -> str:
        """The letters of a message's floating-point numbers; not all alike if it holds others."""
        if isinstance(type_, BasicType):
            return code if (code := CODES[type_.typename]) in "fd" else "?!"
        if isinstance(type_, NamespacedType):
            fields = self.class_of(type_.full_name)._DEFINITION.fields
            return "".join(self.plain_codes(field.type) for field in fields)
        return "?!"

    def row_sequence(self, codes: str, count: str, target: str) -> None:
        """A view of numbers that lie one after another, a row for each message."""
        import numpy as np

        size, width = SIZES[codes[0]], len(codes)
        dtype = self.name()
        self.environment.update({"ndarray": np.ndarray, dtype: np.dtype(self.order + codes[0])})
        position = self.position()
        self.line(f"begin = {position} + 3 & -8 | 4 if {count} and {size} == 8 else {position}")
        self.line(f"end = begin + {count} * {size * width}")
        self.line("if end > len(data): raise ValueError")
        owner, _, name = target.rpartition(".")
        self.line(f"{owner}.{raw_name(name)} = ndarray(({count}, {width}), {dtype}, data, begin)")
        self.jump("end", min(size, 4))

    def number_sequence(self, code: str, count: str, target: str) -> None:
        size = SIZES[code]
        position = self.position()
        if size == 8 and not (self.modulus == 8 and self.remainder == 0):
            self.line(f"begin = {position} + 3 & -8 | 4 if {count} else {position}")
            position = "begin"
        self.line(f"end = {position} + {count} * {size}")
        self.line("if end > len(data): raise ValueError")
        swap = size > 1 and (self.order == "<") != (sys.byteorder == "little")
        self.line(f"{target} = numbers({code!r}, memoryview(data)[{position}:end], {swap})")
        self.jump("end", min(size, 4))

    def small_values(self, value_type: AbstractType, count: str, target: str) -> None:
        self.bounded_end(count)
        content = f"data[{self.position()}:end]"
        if value_type == BasicType("boolean"):
            self.line(f"{target} = [v != 0 for v in {content}]")
        else:
            self.line(f"{target} = [bytes((v,)) for v in {content}]")
        self.jump("end", 1)

    def array(self, type_: Array, target: str) -> None:
        code = element_code(type_)
        if code:
            self.align(SIZES[code])
            self.flush()
            self.number_array(type_, code, target)
        elif type_.value_type in (BasicType("octet"), BasicType("boolean")):
            self.flush()
            self.small_values(type_.value_type, str(type_.size), target)
        else:
            self.flush()
            self.loop(type_.value_type, str(type_.size), target)

    def number_array(self, type_: Array, code: str, target: str) -> None:
        size = SIZES[code] * type_.size
        if self.order == "<":
            owner, _, name = target.rpartition(".")
            self.bounded_end(str(size))
            self.line(f"{owner}.{raw_name(name)} = data[{self.position()}:end]")
        else:
            self.numpy_array(type_, target)
        self.offset += size
        self.remainder = (self.remainder + size) % self.modulus

    def numpy_array(self, type_: Array, target: str) -> None:
        import numpy as np

        dtype = np.dtype(numpy_name(str(type_.value_type)))
        wire, native = self.name(), self.name()
        self.environment.update(
            {
                "frombuffer": np.frombuffer,
                wire: np.dtype(f"{self.order}{dtype.str[1:]}"),
                native: dtype,
            }
        )
        self.line(
            f"{target} = frombuffer(data, {wire}, {type_.size}, {self.position()}).astype({native})"
        )

    def loop(self, value_type: AbstractType, count: str, target: str) -> None:
        """Read the elements one by one.

        What is known about the position must hold before the first and after each of them.
        """
        values, item = self.name(), self.name()
        self.line(f"{values} = {target} = []")
        self.line(f"p = {self.position()}")
        self.base, self.offset = "p", 0
        self.line(f"for _ in range({count}):")
        outer_indent, self.indent = self.indent, self.indent + " "
        start = len(self.lines)
        modulus, remainder = self.modulus, self.remainder
        while True:
            del self.lines[start:]
            self.value(value_type, item)
            self.flush()
            self.line(f"{values}.append({item})")
            if self.offset or self.base != "p":
                self.line(f"p = {self.position()}")
            self.base, self.offset = "p", 0
            common = gcd(gcd(modulus, self.modulus), remainder - self.remainder)
            settled = common == modulus
            modulus, remainder = common, remainder % common
            self.modulus, self.remainder = modulus, remainder
            if settled:
                break
        self.indent = outer_indent

    # -- bytes

    def number(self, code: str, target: str) -> None:
        """Add one number to the pending format."""
        self.align(SIZES[code])
        self.format += code
        self.targets.append(target)
        self.remainder = (self.remainder + SIZES[code]) % self.modulus

    def length(self, type_: AbstractType, extra: int = 0) -> str:
        """Read a length and hold it against the bound of its type."""
        count = self.name()
        self.number("I", count)
        self.flush()
        maximum = getattr(type_, "maximum_size", None)
        if maximum is not None:
            self.line(f"if {count} > {maximum + extra}: raise ValueError")
        return count

    def bounded_end(self, size: str) -> None:
        self.line(f"end = {self.position()} + {size}")
        self.line("if end > len(data): raise ValueError")

    def align(self, size: int) -> None:
        """Skip to a multiple of ``size``."""
        if size <= self.modulus:
            missing = -self.remainder % size
            self.format += "x" * missing
            self.remainder = (self.remainder + missing) % self.modulus
            return
        self.flush()
        # Aligned from the end of the header: for 8 the positions in `data` are 4 modulo 8.
        aligned = (
            f"{self.position()} + 3 & -8 | 4"
            if size == 8
            else f"{self.position()} + {size - 1} & {-size}"
        )
        self.line(f"p = {aligned}")
        self.base, self.offset, self.modulus, self.remainder = "p", 0, size, 0

    def flush(self) -> None:
        """Read the pending numbers."""
        if not self.format:
            return
        unpack = Struct(self.order + self.format)
        if self.targets:
            name = self.name()
            self.environment[name] = unpack.unpack_from
            comma = "," if len(self.targets) == 1 else ""
            self.line(f"{', '.join(self.targets)}{comma} = {name}(data, {self.position()})")
        self.offset += unpack.size
        self.format = ""
        self.targets = []

    def position(self) -> str:
        if not self.base:
            return str(self.offset)
        return f"{self.base} + {self.offset}" if self.offset else self.base

    def jump(self, position: str, modulus: int) -> None:
        self.line(f"p = {position}")
        self.base, self.offset = "p", 0
        self.modulus = min(self.modulus, modulus)
        self.remainder %= self.modulus

    # -- source

    def line(self, text: str) -> None:
        self.lines.append(self.indent + text)

    def name(self) -> str:
        self.names += 1
        return f"_{self.names}"
