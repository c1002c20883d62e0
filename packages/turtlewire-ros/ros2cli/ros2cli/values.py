"""Values on the command line."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = [
    "assignment",
    "positive_float",
    "positive_int",
    "read_values",
    "regular_expression",
    "shortened",
    "unsigned_int",
]

#: How many values YAML aliases may add to those that are written out.
_MOST_COPIES = 100_000
_LONGEST_ERROR = 1000


def read_values(text: str) -> dict[str, Any]:
    """Return the mapping in a YAML string; an empty string gives an empty mapping.

    Raises:
        RuntimeError: The text is not a mapping, contains an invalid date, or is too large because
            of aliases or nesting.
        yaml.YAMLError: The text is not YAML.
    """
    import yaml

    try:
        values = yaml.safe_load(text)
        size = _size(values, {})
    except RecursionError:
        raise RuntimeError("The passed value is nested too deeply") from None
    except ValueError as error:
        raise RuntimeError(f"The passed value holds what looks like a date: {error}") from None
    if size > len(text) + _MOST_COPIES:  # each value that is written out has a character of its own
        raise RuntimeError("The aliases of the passed value expand to too many values")
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise RuntimeError(  # noqa: TRY004  what the commands print as one line
            "The passed value needs to be a dictionary in YAML format"
        )
    return values


def _size(value: Any, known: dict[int, float]) -> float:
    """Count the values in ``value`` with its YAML aliases expanded."""
    parts = value.values() if isinstance(value, dict) else value
    if not isinstance(value, (dict, list)):
        return 1
    if id(value) not in known:
        known[id(value)] = float("inf")  # what contains itself has no end
        known[id(value)] = 1 + sum(_size(part, known) for part in parts)
    return known[id(value)]


def shortened(error: object) -> str:
    """Return the text of an error, cut where it quotes a value of any length."""
    text = str(error)
    return text if len(text) <= _LONGEST_ERROR else f"{text[:_LONGEST_ERROR]}..."


def assignment(text: str) -> tuple[str, str]:
    """Name and value of ``name:=value``, for argparse."""
    name, separator, value = text.partition(":=")
    if not separator or not name:
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form name:=value")
    return name, value


def positive_float(inval: str) -> float:
    """Return a number above zero, for argparse."""
    value = float(inval)
    if not value > 0:
        raise argparse.ArgumentTypeError("value must be positive")
    return value


def regular_expression(text: str) -> str:
    """Return a regular expression on the command line.

    Raises:
        argparse.ArgumentTypeError: It is none.
    """
    import re

    try:
        re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not a regular expression: {error}") from None
    return text


def positive_int(string: str) -> int:
    """Return a whole number above zero, for argparse."""
    value = int(string)
    if value <= 0:
        raise argparse.ArgumentTypeError("value must be positive")
    return value


def unsigned_int(text: str) -> int:
    """Return a whole number from zero, for argparse."""
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError("value must be non-negative integer")
    return value
