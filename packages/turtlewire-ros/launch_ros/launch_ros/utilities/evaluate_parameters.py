"""Evaluates parameter values: substitutions, types and nested mappings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch.frontend.type_utils import coerce, list_item_type
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_SCALARS = (str, bool, int, float, bytes)


def evaluate_parameter_dict(
    context: LaunchContext, parameters: Mapping[Any, Any]
) -> dict[str, Any]:
    """Return flat names, joined by dots, with performed values.

    Raises:
        TypeError: Parameters cannot have the type of a value.
    """
    flat: dict[str, Any] = {}
    for key, value in parameters.items():
        name = perform_substitutions(context, normalize_to_list_of_substitutions(key))
        if hasattr(value, "items"):
            flat |= {
                f"{name}.{inner}": item
                for inner, item in evaluate_parameter_dict(context, value).items()
            }
        else:
            flat[name] = evaluate_value(context, value, name)
    return flat


def evaluate_parameters(context: LaunchContext, parameters: Iterable[Any]) -> list[Any]:
    """Return each of several parameter sets, evaluated.

    Args:
        context: The launch.
        parameters: As of :func:`launch_ros.utilities.normalize_parameters.normalize_parameters`.

    Returns:
        A mapping of flat names to values for a mapping, a path for a file, and a ``Parameter``,
        evaluated, for one.
    """
    evaluated: list[Any] = []
    for parameter in parameters:
        if hasattr(parameter, "items"):
            evaluated.append(evaluate_parameter_dict(context, parameter))
        elif hasattr(parameter, "param_file"):
            evaluated.append(parameter.evaluate(context))
        else:
            parameter.evaluate(context)
            evaluated.append(parameter)
    return evaluated


def evaluate_value(context: LaunchContext, value: Any, name: str = "") -> Any:
    """Return the value of a parameter.

    Text stays text. Substitutions, and lists of text and substitutions, are joined and mean what
    YAML makes of them. Other sequences must hold values of one type.

    Args:
        context: The launch.
        value: What the user wrote.
        name: Names the parameter in errors.

    Raises:
        TypeError: Parameters cannot have its type.
    """
    if hasattr(value, "evaluate"):
        return value.evaluate(context)
    if isinstance(value, _SCALARS):
        return value
    if isinstance(value, Substitution):
        return typed(perform_substitutions(context, [value]), None)
    if not hasattr(value, "__iter__") or hasattr(value, "items"):
        raise TypeError(
            f"the parameter '{name}' has a value of type {type(value).__name__}; "
            "allowed are text, numbers, truth values, "
            "substitutions, and sequences of one of these"
        )
    items = list(value)
    if (
        items
        and any(isinstance(item, Substitution) for item in items)
        and all(isinstance(item, (str, Substitution)) for item in items)
    ):
        # A list with substitutions is one text whose parts are joined, not a sequence.
        return typed(
            perform_substitutions(context, normalize_to_list_of_substitutions(items)), None
        )
    return _uniform([evaluate_value(context, item, name) for item in items], name)


def typed(text: str, value_type: Any) -> Any:
    """Convert a text into a value of a type.

    Args:
        text: The text.
        value_type: The type; None parses it as YAML.

    Raises:
        ValueError: ``text`` is not a value of the type.
        TypeError: The text is not a list, as the type is.
    """
    item_type = list_item_type(value_type)
    if item_type is None:
        return coerce(text, value_type)
    import yaml

    items = yaml.safe_load(text)
    if not isinstance(items, list):
        raise TypeError(f"'{text}' is not a list of {item_type.__name__}")
    # YAML has already made numbers of some items.
    return [coerce(str(item), item_type) for item in items]


def _uniform(items: list[Any], name: str) -> list[Any]:
    kinds = {type(item) for item in items}
    # `[1, 2.5]` has two types, but means one array.
    if kinds == {int, float}:
        return [float(item) for item in items]
    if len(kinds) > 1 or not kinds <= set(_SCALARS):
        found = ", ".join(sorted(kind.__name__ for kind in kinds))
        raise TypeError(
            f"the sequence of the parameter '{name}' must hold values of one type, "
            f"but has {found}: {items}"
        )
    return items
