"""Converts messages and other Python values to values for JSON."""

from __future__ import annotations

import math
from typing import Any

__all__ = ["json_value"]


def json_value(value: Any) -> Any:
    """Return a value for ``json.dumps``.

    A message becomes a dictionary of its fields, and an array a list. A ``byte`` becomes a number,
    and bytes become a list of numbers. Numbers that JSON does not have become the strings ``NaN``,
    ``Infinity`` and ``-Infinity``.

    Args:
        value: A message, a field of one, or a dictionary, list or tuple of such values.
    """
    if hasattr(value, "_DEFINITION"):
        value = {field.name: getattr(value, field.name) for field in value._DEFINITION.fields}
    elif hasattr(value, "tolist"):  # array.array, and NumPy's
        value = value.tolist()
    if isinstance(value, dict):
        return {key: json_value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        # Images have millions of numbers, all integers.
        return value if set(map(type, value)) <= {int} else [json_value(item) for item in value]
    if isinstance(value, bytes):
        return value[0] if len(value) == 1 else list(value)
    if isinstance(value, float):
        return value if math.isfinite(value) else _name_of(value)
    return value


def _name_of(number: float) -> str:
    return "NaN" if math.isnan(number) else "Infinity" if number > 0 else "-Infinity"
