"""Hints in addition to the texts that ROS 2 defines."""

from __future__ import annotations

from enum import Enum
from operator import attrgetter
from typing import Any, TypeVar

_Error = TypeVar("_Error", bound=BaseException)


def with_hint(error: _Error, hint: str) -> _Error:
    """Attach ``hint`` (nothing if empty) and return the same error.

    Tracebacks show it as a note on Python 3.11 and later.
    """
    error.hint = hint  # type: ignore[attr-defined]
    if hint and hasattr(error, "add_note"):
        error.add_note(hint)
    return error


def described(value: Any) -> str:
    """Describe a value: ``None``, ``the class String``, ``an object of type float``."""
    if value is None:
        return "None"
    return (
        f"the class {value.__qualname__}"
        if isinstance(value, type)
        else f"an object of type {type(value).__qualname__}"
    )


def require(value: object, kind: type) -> None:
    """Raise the AssertionError that ROS 2 raises for a value of another type.

    Unlike an ``assert`` statement, it also works under ``python -O``.
    """
    if not isinstance(value, kind):
        raise AssertionError(  # noqa: TRY004 - ROS 2's error
            f"expected an object of type {kind.__name__}, got {described(value)}"
        )


def checked_property(name: str, kind: type, doc: str) -> Any:
    """Return a property that refuses values of other types, as ROS 2 does.

    Args:
        name: Its name; the value is in the attribute with an underscore before it.
        kind: The type. For an enumeration, numbers become its members.
        doc: The documentation of the property.
    """
    slot, is_enumeration = f"_{name}", issubclass(kind, Enum)

    def write(self: Any, value: Any) -> None:
        require(value, int if is_enumeration else kind)
        setattr(self, slot, kind(value) if is_enumeration else value)

    return property(attrgetter(slot), write, doc=doc)
