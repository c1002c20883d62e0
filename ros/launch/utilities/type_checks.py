"""Type checks of arguments."""

from __future__ import annotations

import inspect
from typing import Any, TypeGuard, TypeVar

__all__ = ["ensure_argument_type", "is_a", "is_a_subclass"]

_T = TypeVar("_T")


def is_a(obj: Any, entity_type: type[_T]) -> TypeGuard[_T]:
    """Whether ``obj`` is an instance of the type."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: Any, entity_type: type) -> bool:
    """Whether ``obj`` is an instance or a subclass of the type."""
    return isinstance(obj, entity_type) or (inspect.isclass(obj) and issubclass(obj, entity_type))


def ensure_argument_type(
    argument: Any,
    types: type | tuple[type, ...] | list[type],
    argument_name: str,
    caller: str | None = None,
) -> None:
    """Refuse an argument that has none of the types.

    Raises:
        TypeError: It has none of them; the text names argument, value and types.
    """
    allowed = tuple(types) if isinstance(types, (tuple, list)) else (types,)
    if any(is_a_subclass(argument, kind) for kind in allowed):
        return
    names = ", ".join(f"'{kind.__name__}'" for kind in allowed)
    expected = names if len(allowed) == 1 else f"one of [{names}]"
    where = "" if caller is None else f" of {caller}"
    raise TypeError(
        f"Expected '{argument_name}'{where} to be of type {expected}, "
        f"but got '{argument}' of type '{type(argument)}'"
    )
