"""Generates the function that decodes one message type from the bytes of ROS 1.

They are little endian, nothing is aligned, strings have no terminator, and a message without fields
takes no byte.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from turtlewire.msg.decoder import Decoder
from turtlewire.msg.encoder import SIZES

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.msg.types import AbstractString, AbstractType

__all__ = ["make_ros1_decoder"]


def make_ros1_decoder(
    cls: type[Any], class_of: Callable[[str], type[Any]]
) -> Callable[[bytes], Any]:
    """Generate ``decode(data) -> message``, which raises if bytes are missing or left over.

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
