"""Type checks of arguments."""

from __future__ import annotations

from typing import Any

from launch.utilities.class_tools_impl import is_a_subclass


def ensure_argument_type(
    argument: Any,
    types: type | tuple[type, ...] | list[type],
    argument_name: str,
    caller: str | None = None,
) -> None:
    """Raise if an argument has none of the types.

    Raises:
        TypeError: The argument has none of the types; the message names argument, value and types.
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
