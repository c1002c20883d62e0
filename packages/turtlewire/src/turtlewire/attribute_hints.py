"""AttributeErrors that say what to use, for names that people know from other libraries."""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = ["hint_at"]

_Class = TypeVar("_Class", bound=type)


class _Absent:
    """An attribute that does not exist: getting it raises an AttributeError with advice."""

    def __init__(self, name: str, instead: str) -> None:
        self._name = name
        self._instead = instead

    def __get__(self, instance: object, owner: type) -> NoReturn:
        name = repr(owner.__name__)
        whose = f"type object {name}" if instance is None else f"{name} object"
        raise AttributeError(f"{whose} has no attribute {self._name!r}; use {self._instead}")

    def __repr__(self) -> str:
        return f"<no attribute; use {self._instead}>"


def hint_at(advice: Mapping[str, str]) -> Callable[[_Class], _Class]:
    """Return a class decorator that adds advice to the AttributeErrors of some names.

    ``__getattr__`` would do the same, but it slows all method calls of a compiled class.

    Args:
        advice: What to use instead of an attribute that does not exist. A key is a name, or
            several names with spaces between them.
    """

    def decorate(cls: _Class) -> _Class:
        for names, instead in advice.items():
            for name in names.split():
                setattr(cls, name, _Absent(name, instead))
        setattr(cls, "__dir__", _existing_names)  # noqa: B010 (mypy refuses the assignment)
        return cls

    return decorate


def _existing_names(instance: object) -> list[str]:
    """Return what ``dir()`` lists, so that shells do not complete names that do not exist."""
    from inspect import getattr_static

    names = object.__dir__(instance)
    return [name for name in names if type(getattr_static(instance, name, None)) is not _Absent]
