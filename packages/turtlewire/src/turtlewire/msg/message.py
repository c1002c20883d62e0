"""The base of all message classes; `turtlewire.msg.classes` makes the classes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.msg.definition import split_name
from turtlewire.msg.types import Array
from turtlewire.msg.values import element_code

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    from turtlewire.msg.definition import MessageDefinition
    from turtlewire.msg.types import AbstractType
    from turtlewire.msg.values import Cdr

    #: A class of messages. Its default makes ``Publisher`` without brackets a valid annotation.
    MessageT = TypeVar("MessageT", bound="Message", default=Any)
else:  # the default came with Python 3.13
    from typing import TypeVar

    MessageT = TypeVar("MessageT")


class _FieldTypes:
    """``_fields_and_field_types``, which programs read although it is private in ROS 2."""

    def __get__(self, message: Message | None, cls: type[Message]) -> dict[str, str]:
        return cls.get_fields_and_field_types()


class Message:
    """Base of all message classes.

    Attributes:
        SLOT_TYPES: The types of the fields, in order.
    """

    __slots__: tuple[str, ...] = ()
    SLOT_TYPES: tuple[AbstractType, ...] = ()
    _TYPE_NAME: str
    _DEFINITION: MessageDefinition
    _MISSING_FIELDS: tuple[str, ...] = ()
    _fields_and_field_types = _FieldTypes()

    if TYPE_CHECKING:  # each class gets its own methods when it is created

        def __init__(self, **fields: Any) -> None: ...

        def _to_cdr(self) -> Cdr: ...

        @classmethod
        def _from_cdr(cls, data: bytes) -> Message: ...

        @classmethod
        def _from_cdr_big_endian(cls, data: bytes) -> Message: ...

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Names and types of the fields, in order.

        ROS 2 spells the types ``sequence<double>``, ``geometry_msgs/Vector3``.
        """
        return {field.name: str(field.type) for field in cls._DEFINITION.fields}

    def __repr__(self) -> str:
        package, kind, name = split_name(self._TYPE_NAME)
        arguments = ", ".join(
            f"{field.name}={_repr_value(field.type, getattr(self, field.name))}"
            for field in self._DEFINITION.fields
        )
        return f"{package}.{kind}.{name}({arguments})"

    def __eq__(self, other: object) -> bool:
        if getattr(other, "_TYPE_NAME", None) != self._TYPE_NAME:
            return False
        for field in self._DEFINITION.fields:
            equal = getattr(self, field.name) == getattr(other, field.name)
            if not (equal if isinstance(equal, bool) else _all_equal(equal)):
                return False
        return True

    __hash__ = None  # type: ignore[assignment]


def missing_fields(message: Message) -> tuple[str, ...]:
    """Return the fields that the writer of a received or recorded message does not know.

    They have their defaults, because its definition differs from ours: ``("variance",)`` for a
    Range of an old bag. Fields of fields are named ``markers.texture``.
    """
    return message._MISSING_FIELDS


def _repr_value(type_: AbstractType, value: Any) -> str:
    if element_code(type_) and not isinstance(type_, Array):
        return repr(value.tolist()) if hasattr(value, "tolist") else repr(value)
    return repr(value)


def _all_equal(comparison: Any) -> bool:
    return bool(comparison.all()) if hasattr(comparison, "all") else bool(comparison)
