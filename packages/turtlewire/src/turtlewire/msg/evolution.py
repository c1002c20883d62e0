"""Reads messages that were written with another definition than ours.

ROS 2 sometimes adds fields to its messages: `Range` got ``variance``, `Marker` its textures. In
ROS 1, each header had a ``seq``. One rule holds for all bags and for the network:

- The bytes are decoded by the definition of their writer; the result is a message of our class.
- Fields are matched by name, in upper or lower case. A field of theirs fits one of ours if ours
  takes every value of it: ``int32`` fits ``int64`` and ``double``, not ``float``.
- A field of ours that none of theirs fits has its default, and `turtlewire.msg.missing_fields`
  returns its name. A field that only theirs has is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from turtlewire.errors import CdrError, InterfaceError
from turtlewire.msg.classes import get_message
from turtlewire.msg.decoder import make_decoder
from turtlewire.msg.definition import MessageDefinition, nested_types
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    INTEGER_RANGES,
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import array_of_bytes, element_code, numpy_name, raw_name
from turtlewire.msg.written_records import WrittenRecords

if TYPE_CHECKING:
    from turtlewire.msg.definition import Field
    from turtlewire.msg.message import Message
    from turtlewire.msg.types import AbstractType

#: Fields that were added to messages of ROS 2 since Dashing, until Jazzy.
_ADDED = {
    "rcl_interfaces/msg/ParameterDescriptor": {"dynamic_typing"},
    "rosbag2_interfaces/msg/ReadSplitEvent": {"node_name"},
    "rosbag2_interfaces/msg/WriteSplitEvent": {"node_name"},
    "sensor_msgs/msg/Range": {"variance"},
    "shape_msgs/msg/SolidPrimitive": {"polygon"},
    "visualization_msgs/msg/Marker": {
        "texture_resource",
        "texture",
        "uv_coordinates",
        "mesh_file",
    },
}

#: The largest integers that each floating-point type holds exactly.
_EXACT = {"float": 2**24, "double": 2**53}


def differs(full_name: str, written: Mapping[str, MessageDefinition]) -> bool:
    """Return whether these definitions lead to other bytes than ours.

    Args:
        full_name: A message that is known.
        written: The definitions of the writer, by full name; a type that is not among them is ours.

    Raises:
        InterfaceError: A type in the message is not known.
    """
    return _differs(load_message(full_name), full_name, written)


def _differs(
    ours: MessageDefinition, full_name: str, written: Mapping[str, MessageDefinition]
) -> bool:
    theirs = written.get(full_name) or load_message(full_name)
    if theirs is ours:
        return False
    if len(theirs.fields) != len(ours.fields):
        return True
    for mine, other in zip(ours.fields, theirs.fields, strict=True):
        if mine.name.lower() != other.name.lower() or mine.type != other.type:
            return True
    return any(_differs(load_message(name), name, written) for name in nested_types(ours))


@cache
def older_evolution(full_name: str) -> Evolution | None:
    """Return the decoder for the message as older ROS 2 had it; None if it was always the same.

    A bag or a network often does not say which definition its bytes follow.
    """
    try:
        ours = _all_definitions(full_name)
    except InterfaceError:
        return None
    if not ours.keys() & _ADDED.keys():
        return None
    older = {
        name: MessageDefinition(
            name,
            tuple(each for each in one.fields if each.name not in _ADDED.get(name, ())),
            one.constants,
        )
        for name, one in ours.items()
    }
    return Evolution(full_name, older, exact=True)


def _all_definitions(full_name: str) -> dict[str, MessageDefinition]:
    """Return our definitions of a message and of all messages in it."""
    found: dict[str, MessageDefinition] = {}
    waiting = [full_name]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found[name] = load_message(name)
            waiting += nested_types(found[name])
    return found


class Evolution:
    """Decodes the messages of one type as their writer defined it.

    Args:
        full_name: The message, which is known.
        written: The definitions of the writer, by full name; a type that is not among them is ours.
        is_ros1: Whether the bytes are in ROS 1's encoding instead of CDR.
        exact: Whether bytes that are left over are an error.

    Attributes:
        missing: See `turtlewire.msg.missing_fields`.

    Raises:
        InterfaceError: A type in the message is not known.
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
        self._records = WrittenRecords(full_name, written, is_ros1=is_ros1, exact=exact)
        self._decode_ours: Callable[[bytes], Message] | None = None
        self._conversions: dict[tuple[str, str], tuple[Any, tuple[str, ...], Any]] = {}
        self._convert, self.missing, self._class = self._message(full_name, full_name)

    def decode(self, data: bytes) -> Message:
        """Decode a message.

        Raises:
            CdrError: The bytes do not follow the definition of their writer.
        """
        try:
            message: Message = self._convert(self._records.decode(data))
        except CdrError:
            raise
        except Exception as fault:
            raise self._fault(data, fault) from fault
        return message

    def decode_ours(self, data: bytes) -> Message:
        """Decode what `decode` returned and `serialize` encoded: `missing_fields` are known again.

        Raises:
            CdrError: The bytes are malformed.
        """
        if self._decode_ours is None:
            self._decode_ours = make_decoder(self._class, "<", get_message)
        try:
            return self._decode_ours(data)
        except Exception as fault:
            raise self._fault(data, fault) from fault

    def _fault(self, data: bytes, fault: Exception) -> CdrError:
        return CdrError(
            f"{self._name}: its {len(data)} bytes do not follow its definition: "
            f"{str(fault) or 'they end too early'}"
        )

    # -- from their values to ours

    def _message(self, ours: str, theirs: str) -> tuple[Any, tuple[str, ...], Any]:
        """Return the conversion of a message, the fields missing in theirs, and its class."""
        found = self._conversions.get((ours, theirs))
        if found is None:
            found = self._conversions[ours, theirs] = self._new_message(ours, theirs)
        return found

    def _new_message(self, ours: str, theirs: str) -> tuple[Any, tuple[str, ...], Any]:
        cls: type[Message] = get_message(ours)
        definition = self._records.definition(theirs)
        their_fields = {field.name.lower(): field for field in definition.fields}
        their_fields |= {field.name: field for field in definition.fields}
        steps: list[tuple[str, Any]] = []
        missing: list[str] = []
        for field in cls._DEFINITION.fields:
            other = their_fields.get(field.name) or their_fields.get(field.name.lower())
            convert, inner = self._value(field.type, other.type) if other else (None, ())
            if other is None or convert is None:
                missing.append(field.name)
                continue
            missing += [f"{field.name}.{name}" for name in inner]
            steps.append((field.name, _reader(other, convert)))
        if missing:
            extra = {"__slots__": (), "__module__": cls.__module__, "__doc__": cls.__doc__}
            cls = type(cls.__name__, (cls,), {**extra, "_MISSING_FIELDS": tuple(missing)})

        def convert_message(record: Any) -> Message:
            message = cls()
            for name, read in steps:
                setattr(message, name, read(record))
            return message

        return convert_message, tuple(missing), cls

    def _value(self, ours: AbstractType, theirs: AbstractType) -> tuple[Any, tuple[str, ...]]:
        """Return the conversion of a value, None if it does not fit, and what is missing in it."""
        if isinstance(ours, AbstractNestedType):
            return self._values(ours, theirs)
        if isinstance(ours, NamespacedType):
            if not isinstance(theirs, NamespacedType):
                return None, ()
            return self._message(ours.full_name, theirs.full_name)[:2]
        if isinstance(ours, AbstractGenericString):
            return (_same if isinstance(theirs, AbstractGenericString) else None), ()
        if isinstance(ours, BasicType) and isinstance(theirs, BasicType):
            return _number(ours.typename, theirs.typename), ()
        return None, ()

    def _values(
        self, ours: AbstractNestedType, theirs: AbstractType
    ) -> tuple[Any, tuple[str, ...]]:
        if not isinstance(theirs, AbstractNestedType):
            return None, ()
        if isinstance(ours, Array) and not (isinstance(theirs, Array) and theirs.size == ours.size):
            return None, ()
        convert, missing = self._value(ours.value_type, theirs.value_type)
        if convert is None or (convert is _same and element_code(ours)):
            return convert, missing  # the assignment makes the right array
        return (lambda values: [convert(value) for value in values]), missing


def _reader(field: Field, convert: Any) -> Any:
    """Return the function that reads a field of a record as a value of ours."""
    name = field.name
    if not isinstance(field.type, Array) or not element_code(field.type):
        return lambda record: convert(getattr(record, name))
    raw, dtype = raw_name(name), numpy_name(str(field.type.value_type))

    def read(record: Any) -> Any:
        content = getattr(record, raw, None)
        return convert(getattr(record, name) if content is None else array_of_bytes(dtype, content))

    return read


def _number(ours: str, theirs: str) -> Any:
    """Return the conversion of a number, bool or byte; None if some values would not fit."""
    if ours == theirs or (ours, theirs) == ("double", "float"):
        return _same
    if (ours, theirs) == ("uint8", "octet"):
        return lambda value: value[0]
    if (ours, theirs) == ("octet", "uint8"):
        return lambda value: bytes((value,))
    low, high = INTEGER_RANGES.get(theirs, (0, 1 if theirs == "boolean" else 2**64))
    if ours in _EXACT:
        return float if -_EXACT[ours] <= low and high <= _EXACT[ours] else None
    least, most = INTEGER_RANGES.get(ours, (0, -1))
    return int if least <= low and high <= most else None


def _same(value: Any) -> Any:
    return value
