"""Values on the command line."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = ["positive_float", "positive_int", "read_values", "unsigned_int"]


def read_values(text: str) -> dict[str, Any]:
    """The mapping that a YAML text is; an empty text is an empty one.

    Raises:
        RuntimeError: It is no mapping.
        yaml.YAMLError: It is no YAML.
    """
    import yaml

    values = yaml.safe_load(text)
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise RuntimeError(  # noqa: TRY004  what the commands print as one line
            "The passed value needs to be a dictionary in YAML format"
        )
    return values


def positive_float(text: str) -> float:
    """A number above zero, for argparse."""
    value = float(text)
    if not value > 0:
        raise argparse.ArgumentTypeError("value must be positive")
    return value


def positive_int(text: str) -> int:
    """A whole number above zero, for argparse."""
    value = int(text)
    if value <= 0:
        raise argparse.ArgumentTypeError("value must be positive")
    return value


def unsigned_int(text: str) -> int:
    """A whole number from zero, for argparse."""
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError("value must be non-negative integer")
    return value
