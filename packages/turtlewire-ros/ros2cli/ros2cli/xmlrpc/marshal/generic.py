"""Functions for the tables of :mod:`xmlrpc.client`, for classes of a kind.

A value is written as an element that has the full name of its class.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from enum import Enum


def fullname(klass: type[Any]) -> str:
    """Return module and name of a class, joined by a dot."""
    return f"{klass.__module__}.{klass.__name__}"


def dump_any_with_slots(
    marshaller: Any,
    value: Any,
    write: Callable[[str], object],
    transform: Callable[[str], str] | None = None,
) -> None:
    """Write a value with its attributes, those in ``__slots__`` if its class has some.

    Args:
        marshaller: Writes the attributes.
        value: The value.
        write: Takes the text.
        transform: Makes the name of an argument of the constructor from that of its attribute.
    """
    names = getattr(value, "__slots__", None) or vars(value)
    attributes = {
        name if transform is None else transform(name): getattr(value, name) for name in names
    }
    tag = fullname(type(value))
    write(f"<value><{tag}>")
    marshaller.dump_struct(attributes, write)
    write(f"</{tag}></value>\n")


def end_any_with_slots(unmarshaller: Any, data: str, type_: type[Any]) -> None:  # noqa: ARG001
    """Make a value from its attributes, at the end of its element."""
    attributes = unmarshaller._stack.pop()
    _append(unmarshaller, type_(**attributes))


def dump_any_enum(marshaller: Any, value: Enum, write: Callable[[str], object]) -> None:  # noqa: ARG001
    """Write a member of an enumeration of numbers."""
    tag = fullname(type(value))
    write(f"<value><{tag}>{value.value}</{tag}></value>\n")


def end_any_enum(unmarshaller: Any, data: str, enum_: Callable[[int], Enum]) -> None:
    """Make a member of an enumeration, at the end of its element."""
    _append(unmarshaller, enum_(int(data)))


def _append(unmarshaller: Any, value: Any) -> None:
    unmarshaller.append(value)
    # As the library's own functions do: the element of this value has been read.
    unmarshaller._value = 0
