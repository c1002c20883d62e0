"""Decodes and encodes messages by the definitions of their writer instead of ours."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from turtlewire.errors import CdrError
from turtlewire.msg.decoder import Decoder, make_decoder
from turtlewire.msg.encoder import SIZES, make_encoder
from turtlewire.msg.registry import load_message

if TYPE_CHECKING:
    from turtlewire.msg.definition import MessageDefinition
    from turtlewire.msg.types import AbstractString, AbstractType


class WrittenRecords:
    """The messages of one type as plain objects with the fields that their writer had.

    Args:
        full_name: The type.
        written: The definitions of the writer, by full name; a type that is not among them is ours.
        is_ros1: Whether the bytes to decode are in ROS 1's encoding instead of CDR.
        exact: Whether bytes that are left over are an error.
    """

    def __init__(
        self,
        full_name: str,
        written: Mapping[str, MessageDefinition],
        *,
        is_ros1: bool = False,
        exact: bool = False,
    ) -> None:
        self._name = full_name
        self._written = written
        self._classes: dict[str, type[Any]] = {}
        self._decoders: dict[bytes, Callable[[bytes], Any]] = {}
        self._encode: Callable[[Any], Any] | None = None
        self._is_ros1 = is_ros1
        self._exact = exact

    def definition(self, full_name: str) -> MessageDefinition:
        """Return the definition of a type.

        Raises:
            InterfaceError: The type is not known.
        """
        return self._written.get(full_name) or load_message(full_name)

    def decode(self, data: bytes) -> Any:
        """Return an object with the values of a message; any exception means malformed bytes."""
        key = b"" if self._is_ros1 else data[:2]
        decode = self._decoders.get(key)
        if decode is None:
            decode = self._decoders[key] = self._decoder(key)
        return decode(data)

    def encode(self, record: Any) -> bytes:
        """Return the little endian CDR of an object that `decode` returned."""
        if self._encode is None:
            self._encode = make_encoder(self._class(self._name), self.definition)
        cdr = self._encode(record)
        return b"".join(cdr) if type(cdr) is tuple else bytes(cdr)  # type: ignore[arg-type]

    def _decoder(self, key: bytes) -> Callable[[bytes], Any]:
        record = self._class(self._name)
        if self._is_ros1:
            return _make_ros1_decoder(record, self._class)
        if key not in (b"\x00\x01", b"\x00\x00"):
            raise CdrError(f"{self._name}: unknown encapsulation {key.hex(' ')} at offset 0")
        order = "<" if key[1] else ">"
        return make_decoder(record, order, self._class, exact=self._exact)

    def _class(self, full_name: str) -> type[Any]:
        """Return a class for what the writer's bytes hold."""
        found = self._classes.get(full_name)
        if found is None:
            content = {"_TYPE_NAME": full_name, "_DEFINITION": self.definition(full_name)}
            found = self._classes[full_name] = type("Record", (), content)
        return found


def _make_ros1_decoder(
    cls: type[Any], class_of: Callable[[str], type[Any]]
) -> Callable[[bytes], Any]:
    """Generate ``decode(data) -> message``, which raises if bytes are missing or left over.

    ROS 1's bytes are little endian, nothing is aligned, strings have no terminator, and a message
    without fields takes no byte.

    Args:
        cls: The class; its ``_DEFINITION`` has the fields in the order of the bytes.
        class_of: Finds the class of a nested message by its full name.
    """
    return _Ros1Decoder(class_of).compile(cls)


class _Ros1Decoder(Decoder):
    """Writes the source of one decoding function."""

    no_fields_code = ""

    def __init__(self, class_of: Callable[[str], type[Any]]) -> None:
        super().__init__("<", class_of)
        self.modulus = 1
        self.offset = 0

    def finish(self) -> None:
        """Refuse bytes after the message, which only another definition explains."""
        self.line(f"if len(data) != {self.position()}: raise ValueError('its size differs')")

    def text(self, type_: AbstractString, target: str) -> None:
        """Read a string."""
        self.bounded_end(self.length(type_))
        self.line(f"{target} = data[{self.position()}:end].decode()")
        self.jump("end", 1)

    def align(self, size: int) -> None:
        """Do nothing."""

    def number_sequence(self, code: str, count: str, target: str) -> None:
        """Read numbers that lie where the count ends."""
        self.bounded_end(f"{count} * {SIZES[code]}")
        swap = SIZES[code] > 1 and sys.byteorder == "big"
        content = f"memoryview(data)[{self.position()}:end]"
        self.line(f"{target} = numbers({code!r}, {content}, {swap})")
        self.jump("end", 1)

    def loop(self, value_type: AbstractType, count: str, target: str) -> None:
        """Read the elements one by one; a false count of elements without bytes is refused."""
        self.line(f"if {count} > len(data): raise ValueError")
        super().loop(value_type, count, target)
