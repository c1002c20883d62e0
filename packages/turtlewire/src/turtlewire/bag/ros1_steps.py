"""The steps that convert the messages of a type from the bytes of ROS 1 to CDR.

The compiled core runs them; the kinds are numbered as in ``native/feeds/ros1_to_cdr.hpp``. They
cover nearly all messages. `conversion_steps` returns None for the others, which
`turtlewire.msg.evolution` converts by way of message objects.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import TYPE_CHECKING

from turtlewire.msg.encoder import CODES, SIZES
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    AbstractNestedType,
    Array,
    BasicType,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
)

if TYPE_CHECKING:
    from turtlewire.msg.definition import Field, MessageDefinition
    from turtlewire.msg.types import AbstractType

__all__ = ["Kind", "Step", "conversion_steps"]

#: Kind, size, alignment, and the number of steps in a loop.
Step = tuple[int, int, int, int]

#: Longer arrays are left to message objects.
_MOST_BYTES = 1 << 20


class Kind(IntEnum):
    """The action of a step."""

    NUMBERS = 0
    BOOLEANS = 1
    SKIP = 2
    TEXT = 3
    FRAME = 4
    SEQUENCE = 5
    LOOP = 6
    REPEAT = 7
    ZEROS = 8
    EMPTY_TEXT = 9


class _OtherMessageError(Exception):
    """The steps do not cover a message."""


def conversion_steps(full_name: str, written: Mapping[str, MessageDefinition]) -> list[Step] | None:
    """Return the steps for the messages of a type; None if the steps do not cover them.

    Args:
        full_name: The message.
        written: The definitions of the bag, by full name; a type that is not among them is ours.
    """
    try:
        return _Steps(written).message(full_name, full_name)
    except _OtherMessageError:
        return None


class _Steps:
    def __init__(self, written: Mapping[str, MessageDefinition]) -> None:
        self._written = written

    def message(self, ours: str, theirs: str) -> list[Step]:
        """Return the steps of a message; the fields of both must come in the same order."""
        our_fields = load_message(ours).fields
        waiting = list((self._written.get(theirs) or load_message(theirs)).fields)
        names = {field.name.lower() for field in waiting}
        if len(names) < len(waiting):
            raise _OtherMessageError
        # ROS 2 gives an empty message one byte.
        steps: list[Step] = [] if our_fields else [(Kind.ZEROS, 1, 1, 0)]
        for field in our_fields:
            if field.name.lower() not in names:
                _add(steps, self._default(field))
                continue
            while waiting and waiting[0].name.lower() != field.name.lower():
                _add(steps, self._skip(waiting.pop(0).type))
            if not waiting:
                raise _OtherMessageError
            _add(steps, self._field(field, waiting.pop(0)))
        for field in waiting:
            _add(steps, self._skip(field.type))
        return steps

    def _field(self, ours: Field, theirs: Field) -> list[Step]:
        if ours.name.endswith("frame_id") and ours.type == theirs.type == UnboundedString():
            return [(Kind.FRAME, 0, 1, 0)]
        return self._value(ours.type, theirs.type)

    def _value(self, ours: AbstractType, theirs: AbstractType) -> list[Step]:
        if isinstance(ours, NamespacedType) and isinstance(theirs, NamespacedType):
            return self.message(ours.full_name, theirs.full_name)
        if isinstance(ours, AbstractNestedType) and isinstance(theirs, AbstractNestedType):
            return self._values(ours, theirs)
        if isinstance(ours, BasicType) and (ours == theirs or {ours, theirs} <= _BYTES):
            size = SIZES[CODES[ours.typename]]
            return [(Kind.BOOLEANS if ours == _BOOLEAN else Kind.NUMBERS, size, size, 0)]
        if ours == theirs == UnboundedString():
            return [(Kind.TEXT, 0, 1, 0)]
        raise _OtherMessageError

    def _values(self, ours: AbstractNestedType, theirs: AbstractNestedType) -> list[Step]:
        element = self._value(ours.value_type, theirs.value_type)
        kind, size, align, _ = element[0]
        is_number = len(element) == 1 and isinstance(ours.value_type, BasicType)
        if isinstance(ours, UnboundedSequence) and isinstance(theirs, UnboundedSequence):
            if is_number and kind == Kind.NUMBERS:
                return [(Kind.SEQUENCE, size, align, 0)]
            return [(Kind.LOOP, 0, 1, len(element)), *element]
        if not (isinstance(ours, Array) and isinstance(theirs, Array) and ours.size == theirs.size):
            raise _OtherMessageError
        if ours.size * max(size, 1) > _MOST_BYTES:
            raise _OtherMessageError
        if is_number:
            return [(kind, ours.size * size, align, 0)]
        return [(Kind.REPEAT, ours.size, 1, len(element)), *element]

    def _skip(self, type_: AbstractType) -> list[Step]:
        if not isinstance(type_, BasicType):
            raise _OtherMessageError
        return [(Kind.SKIP, SIZES[CODES[type_.typename]], 1, 0)]

    def _default(self, field: Field) -> list[Step]:
        if field.default is not None:
            raise _OtherMessageError
        return self._zeros(field.type)

    def _zeros(self, type_: AbstractType) -> list[Step]:
        if isinstance(type_, BasicType):
            size = SIZES[CODES[type_.typename]]
            return [(Kind.ZEROS, size, size, 0)]
        if isinstance(type_, NamespacedType):
            fields = load_message(type_.full_name).fields
            steps = [step for field in fields for step in self._default(field)]
            return steps or [(Kind.ZEROS, 1, 1, 0)]
        if isinstance(type_, AbstractNestedType) and not isinstance(type_, Array):
            return [(Kind.ZEROS, 4, 4, 0)]  # no elements
        if isinstance(type_, Array) and isinstance(type_.value_type, BasicType):
            size = SIZES[CODES[type_.value_type.typename]]
            return [(Kind.ZEROS, size * type_.size, size, 0)]
        if type_ == UnboundedString():
            return [(Kind.EMPTY_TEXT, 0, 1, 0)]
        raise _OtherMessageError


_BOOLEAN = BasicType("boolean")
_BYTES = {BasicType("uint8"), BasicType("octet")}


def _add(steps: list[Step], more: list[Step]) -> None:
    """Append steps; numbers of one alignment that follow one another become one step."""
    first, *others = more
    last = len(steps) - 1
    in_loop = any(at + body == last for at, (_, _, _, body) in enumerate(steps) if body)
    if steps and not in_loop and first[::2] == steps[last][::2] == (Kind.NUMBERS, first[2]):
        first = (first[0], first[1] + steps.pop()[1], first[2], 0)
    steps += [first, *others]
