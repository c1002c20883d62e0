"""Finds the fields of messages that can be columns, and the steps that collect them.

The compiled core runs the steps; the kinds are numbered as in ``native/feeds/column_reader.hpp``.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import IntEnum
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import BagError
from turtlewire.msg.encoder import CODES, SIZES
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import UNIT_SIZE
from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from turtlewire.msg.types import AbstractType

__all__ = [
    "ColumnField",
    "ColumnKind",
    "Step",
    "StepKind",
    "column_steps",
    "find_field",
    "read_texts",
]

#: Kind, size, alignment, the number of steps in a loop, and the column.
Step = tuple[int, int, int, int, int]

_NO_COLUMN = (1 << 32) - 1
_TIMES = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")
_POINT_FIELD = "sensor_msgs/msg/PointField"


class StepKind(IntEnum):
    """The kinds of steps that read a message."""

    NUMBERS = 0
    TEXT = 1
    SEQUENCE = 2
    LOOP = 3
    REPEAT = 4


class ColumnKind(IntEnum):
    """The kind of value that a column has for each message."""

    NUMBERS = 0  # one, or as many for each message
    TIME = 1  # nanoseconds
    TEXT = 2
    SEQUENCE = 3  # an array whose length differs
    TEXTS = 4  # a list
    CLOUD_FIELDS = 5  # the layout of a point cloud


class ColumnField(NamedTuple):
    """A field that can be a column.

    Attributes:
        path: ``"pose.pose.position"``.
        kind: The kind of value in its column.
        code: The letter of its numbers, as `turtlewire.msg.encoder.CODES` has it.
        labels: The names of the numbers of a message, or of an element of a sequence of messages;
            empty for a single number.
    """

    path: str
    kind: ColumnKind
    code: str = ""
    labels: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """The bytes of its numbers, or of an element of a sequence."""
        return SIZES[self.code] * max(1, len(self.labels))


def find_field(type_name: str, path: str) -> ColumnField:
    """Return a field of a message.

    Args:
        type_name: ``"sensor_msgs/msg/Imu"``.
        path: Its name, after the names of the fields that contain it and dots.

    Raises:
        BagError: The field does not exist, or it cannot be a column.
    """
    *owners, _ = names = path.split(".")
    inside, done = type_name, ""
    for name in names:
        fields = {field.name: field.type for field in load_message(inside).fields}
        if name not in fields:
            known = ", ".join(done + each for each in fields) or "none"
            near = did_you_mean(name, fields)
            raise BagError(f"{inside} has no field '{name}'").with_hint(
                f"{near}." if near else f"Its fields: {known}."
            )
        done += f"{name}."
        type_ = fields[name]
        if done.count(".") <= len(owners):
            if not isinstance(type_, NamespacedType):
                raise BagError(f"'{done[:-1]}' of {type_name} is {type_}, which has no fields")
            inside = type_.full_name
    return _column(type_name, path, type_)


def _column(type_name: str, path: str, type_: AbstractType) -> ColumnField:
    found = _column_of_values(path, type_)
    if found is not None:
        return found
    error = BagError(f"'{path}' of {type_name} is {type_}, which cannot be a column")
    if isinstance(type_, NamespacedType):
        inner = (f"{path}.{field.name}" for field in load_message(type_.full_name).fields)
        raise error.with_hint(f"Name one of its fields: {', '.join(inner)}.")
    raise error.with_hint("`Bag.messages` and `BagMessage.decode` return whole messages.")


def _column_of_values(path: str, type_: AbstractType) -> ColumnField | None:
    """Return the column of a field; None if it cannot be one."""
    is_nested = isinstance(type_, AbstractNestedType)
    inner = type_.value_type if isinstance(type_, AbstractNestedType) else type_
    code, labels = _alike(inner)
    kind = ColumnKind.NUMBERS
    if isinstance(inner, AbstractString) and not isinstance(type_, Array):
        kind = ColumnKind.TEXTS if is_nested else ColumnKind.TEXT
    elif isinstance(inner, NamespacedType) and inner.full_name in _TIMES and not is_nested:
        kind = ColumnKind.TIME
    elif inner == NamespacedType.parse(_POINT_FIELD) and is_nested and path == "fields":
        kind = ColumnKind.CLOUD_FIELDS
    elif not code or (isinstance(type_, Array) and labels):
        return None
    elif isinstance(type_, Array):
        labels = tuple(f"[{k}]" for k in range(type_.size))
    elif is_nested:
        kind = ColumnKind.SEQUENCE
    return ColumnField(path, kind, code, labels)


def _alike(type_: AbstractType) -> tuple[str, tuple[str, ...]]:
    """Return letter and names of the numbers of a message; no letter if they are not all alike."""
    if isinstance(type_, BasicType):
        return CODES[type_.typename], ()
    if not isinstance(type_, NamespacedType):
        return "", ()
    codes, labels = set(), []
    for field in load_message(type_.full_name).fields:
        code, inner = _alike(field.type)
        codes.add(code)
        labels += [f".{field.name}{label}" for label in inner or [""]]
    return (codes.pop(), tuple(labels)) if len(codes) == 1 else ("", ())


def column_steps(type_name: str, fields: Iterable[ColumnField]) -> list[Step] | None:
    """Return the steps that collect fields, to the columns 0, 1 and so on.

    Returns:
        None if the compiled core cannot collect them: one field lies within another.
    """
    columns = {field.path: (number, field) for number, field in enumerate(fields)}
    steps = _Steps(columns)
    found = steps.message(type_name, "")
    if steps.taken < len(columns):
        return None
    last = max((at for at, step in enumerate(found) if step[4] != _NO_COLUMN), default=-1)
    return found[: last + 1 + found[last][3]]


class _Steps:
    def __init__(self, columns: dict[str, tuple[int, ColumnField]]) -> None:
        self._columns = columns
        self.taken = 0

    def message(self, name: str, prefix: str) -> list[Step]:
        """Return the steps of a message whose fields have this prefix; None is in no column."""
        fields = load_message(name).fields
        steps: list[Step] = [] if fields else [(StepKind.NUMBERS, 1, 1, 0, _NO_COLUMN)]
        for field in fields:
            column = self._columns.get(prefix + field.name)
            if column is not None:
                self.taken += 1
                steps += self._take(*column)
            elif isinstance(field.type, NamespacedType):
                steps += self.message(field.type.full_name, f"{prefix}{field.name}.")
            else:
                steps += self._value(field.type)
        return steps

    def _take(self, number: int, field: ColumnField) -> list[Step]:
        if field.kind == ColumnKind.NUMBERS:
            return [(StepKind.NUMBERS, field.size, SIZES[field.code], 0, number)]
        if field.kind == ColumnKind.TIME:
            return [(StepKind.NUMBERS, 8, 4, 0, number)]
        if field.kind == ColumnKind.TEXT:
            return [(StepKind.TEXT, 0, 1, 0, number)]
        if field.kind == ColumnKind.SEQUENCE:
            return [(StepKind.SEQUENCE, field.size, SIZES[field.code], 0, number)]
        if field.kind == ColumnKind.TEXTS:
            return [(StepKind.LOOP, 0, 1, 1, number), (StepKind.TEXT, 0, 1, 0, _NO_COLUMN)]
        body = _Steps({}).message(_POINT_FIELD, "")
        return [(StepKind.LOOP, 0, 1, len(body), number), *body]

    def _value(self, type_: AbstractType) -> list[Step]:
        if isinstance(type_, BasicType):
            size = SIZES[CODES[type_.typename]]
            return [(StepKind.NUMBERS, size, size, 0, _NO_COLUMN)]
        if isinstance(type_, AbstractWString):
            return [(StepKind.SEQUENCE, UNIT_SIZE, UNIT_SIZE, 0, _NO_COLUMN)]
        if isinstance(type_, AbstractString):
            return [(StepKind.TEXT, 0, 1, 0, _NO_COLUMN)]
        if isinstance(type_, NamespacedType):
            return _Steps({}).message(type_.full_name, "")
        assert isinstance(type_, AbstractNestedType)
        return self._values(type_)

    def _values(self, type_: AbstractNestedType) -> list[Step]:
        element = self._value(type_.value_type)
        kind, size, align, _, _ = element[0]
        is_number = len(element) == 1 and kind == StepKind.NUMBERS
        if isinstance(type_, Array):
            if is_number and type_.size * size < _NO_COLUMN:
                return [(kind, type_.size * size, align, 0, _NO_COLUMN)]
            return [(StepKind.REPEAT, type_.size, 1, len(element), _NO_COLUMN), *element]
        if is_number:
            return [(StepKind.SEQUENCE, size, align, 0, _NO_COLUMN)]
        return [(StepKind.LOOP, 0, 1, len(element), _NO_COLUMN), *element]


@lru_cache(maxsize=64)  # a publisher sends the same names in each message
def read_texts(data: bytes) -> tuple[str, ...]:
    """Return the elements of a sequence of strings in little endian CDR, without its count."""
    texts, at = [], 0
    while at < len(data):
        begin = -(-at // 4) * 4 + 4
        at = begin + int.from_bytes(data[begin - 4 : begin], "little")
        texts.append(data[begin : max(begin, at - 1)].decode())
    return tuple(texts)
