"""Values of types that launch files know: bool, int, float, str and lists of one of them."""

from __future__ import annotations

import typing
from typing import TYPE_CHECKING, Any

from launch.substitution import Substitution
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

ScalarTypesTuple = (int, float, bool, str)
ListTypesTuple = (
    list[int],
    list[float],
    list[bool],
    list[str],
)
AllowedTypesTuple = (*ScalarTypesTuple, *ListTypesTuple)


def is_typing_list(data_type: Any) -> bool:
    """Return True if a type is ``list``, ``List`` or one of them with a type of items."""
    return data_type in (list, typing.List) or typing.get_origin(data_type) is list  # noqa: UP006


def is_valid_scalar_type(data_type: Any) -> bool:
    """Return True if a type is bool, int, float or str."""
    return data_type in ScalarTypesTuple


def extract_type(data_type: Any) -> tuple[Any, bool]:
    """Return the type of a value or of a list's items (None for any), and whether it is a list.

    Raises:
        ValueError: The type is not supported.
    """
    if data_type is None or is_valid_scalar_type(data_type):
        return data_type, False
    if is_typing_list(data_type):
        arguments = [
            each for each in typing.get_args(data_type) if type(each) is not typing.TypeVar
        ]
        if not arguments:
            return None, True
        if len(arguments) == 1 and is_valid_scalar_type(arguments[0]):
            return arguments[0], True
    raise ValueError(f"Unrecognized data type: {data_type}")


def is_instance_of_valid_type(value: Any, *, can_be_str: bool = False) -> bool:
    """Return True if a value is of one of the known types; see :func:`is_instance_of`."""
    return is_instance_of(value, can_be_str=can_be_str)


def is_instance_of(value: Any, data_type: Any = None, *, can_be_str: bool = False) -> bool:
    """Return True if a value has a type.

    Args:
        value: The value.
        data_type: One of the known types; None for any of them.
        can_be_str: Whether text, or a list in which some items are text, is also accepted.
    """
    kind, is_list = extract_type(data_type)
    if data_type is None and isinstance(value, list):
        kinds = {type(item) for item in value} - ({str} if can_be_str else set())
        return len(kinds) <= 1 and kinds <= set(ScalarTypesTuple)
    if not is_list:
        return _is_scalar(value, kind, can_be_str)
    if not isinstance(value, list):
        return can_be_str and isinstance(value, str)
    return all(_is_scalar(item, kind, can_be_str) for item in value)


def _is_scalar(value: Any, kind: Any, can_be_str: bool) -> bool:
    if kind is None:
        return isinstance(value, ScalarTypesTuple)
    # Not `isinstance`, because bool is a subclass of int.
    return type(value) is kind or (can_be_str and isinstance(value, str))


def coerce_to_type(value: str, data_type: Any = None, *, can_be_str: bool = False) -> Any:
    """Read a text as a value of a type, by YAML's rules: ``yes`` and ``on`` are true.

    Args:
        value: The text.
        data_type: bool, int, float, str, or None for what YAML makes of it.
        can_be_str: Whether a text that is no such value is returned as it is.

    Raises:
        ValueError: ``value`` is not a value of the type.
        TypeError: ``value`` is not a string.
    """
    if not isinstance(value, str):
        raise TypeError(f"expected a string, got {type(value).__name__} ({value!r})")
    if data_type is str:
        return value
    import yaml

    try:
        read = yaml.safe_load(value)
    except yaml.YAMLError:
        read = value
    if data_type is None:
        return read if isinstance(read, ScalarTypesTuple) else value
    # YAML reads `1` as an int, but it is a float as well.
    if data_type is float and type(read) is int:
        return float(read)
    if type(read) is data_type:
        return read
    if can_be_str:
        return value
    name = getattr(data_type, "__name__", str(data_type))
    raise ValueError(f"Failed to convert '{value}' to '{name}' using yaml rules")


def coerce_list(value: list[Any], data_type: Any = None, *, can_be_str: bool = False) -> list[Any]:
    """Read a list of texts as values of one type; without a type, of one that all are.

    Raises:
        ValueError: An item is not a value of the type, or the items have several types.
    """
    items = [coerce_to_type(item, data_type, can_be_str=can_be_str) for item in value]
    kinds = {type(item) for item in items} - ({str} if can_be_str else set())
    if data_type is None and len(kinds) > 1:
        # YAML reads `1` and `2.5` as different types.
        if kinds == {int, float}:
            return [float(item) if isinstance(item, int) else item for item in items]
        raise ValueError(f"Cannot convert {value} to a list of one type: it is not uniform")
    return items


def get_typed_value(value: Any, data_type: Any, *, can_be_str: bool = False) -> Any:
    """Read text, or a list of texts, as a value of a type.

    Args:
        value: The text or the texts; ``[1, 2]`` is a text that is a list.
        data_type: One of the known types; None for what YAML makes of it.
        can_be_str: As for :func:`coerce_to_type`.

    Raises:
        ValueError: ``value`` is not a value of the type.
    """
    kind, is_list = extract_type(data_type)
    if isinstance(value, list):
        if data_type is not None and not is_list:
            raise ValueError(f"Cannot convert input '{value}' of type '{list}' to '{data_type}'")
        return coerce_list(value, kind, can_be_str=can_be_str)
    if not is_list:
        import yaml

        read = yaml.safe_load(value) if data_type is None else None
        return (
            read if isinstance(read, list) else coerce_to_type(value, kind, can_be_str=can_be_str)
        )
    return _list_in(value, data_type, kind, can_be_str)


def _list_in(value: str, data_type: Any, kind: Any, can_be_str: bool) -> Any:
    import yaml

    read = yaml.safe_load(value)
    if isinstance(read, list) and all(_is_scalar(item, kind, can_be_str) for item in read):
        return read
    if can_be_str:
        return value
    raise ValueError(f"Cannot convert value '{value}' to a list of type '{data_type}'")


def is_substitution(x: Any) -> bool:
    """Return True for a substitution, or a list of text with at least one substitution."""
    if isinstance(x, Substitution):
        return True
    return (
        isinstance(x, (list, tuple))
        and any(isinstance(item, Substitution) for item in x)
        and all(isinstance(item, (str, Substitution)) for item in x)
    )


def is_normalized_substitution(x: Any) -> bool:
    """Return True if something is a list of nothing but substitutions, with at least one."""
    return isinstance(x, list) and bool(x) and all(isinstance(item, Substitution) for item in x)


def normalize_typed_substitution(value: Any, data_type: Any) -> Any:
    """Return a value of a type, or substitutions that give one, in the form for their performing.

    Args:
        value: A value, a substitution, or a list of values or substitutions.
        data_type: One of the known types; None for any.

    Returns:
        The value, or a list of substitutions; for a list, a list of these.

    Raises:
        TypeError: A value has another type.
    """
    kind, is_list = extract_type(data_type)
    if isinstance(value, (str, Substitution)) or is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if isinstance(value, (list, tuple)) and (is_list or data_type is None):
        return [normalize_typed_substitution(item, kind) for item in value]
    if kind is float and type(value) is int:
        return float(value)
    if is_list or not _is_scalar(value, kind, can_be_str=False):
        raise TypeError(
            f"value='{value}' is not an instance of {data_type}, nor a valid substitution"
        )
    return value


def perform_typed_substitution(context: LaunchContext, value: Any, data_type: Any) -> Any:
    """Return the value that :func:`normalize_typed_substitution` stands for, at run time.

    Raises:
        ValueError: The substituted string is not a value of the type.
    """
    kind, _ = extract_type(data_type)
    if is_normalized_substitution(value):
        return get_typed_value(perform_substitutions(context, value), data_type)
    if isinstance(value, list):
        return [perform_typed_substitution(context, item, kind) for item in value]
    return value
