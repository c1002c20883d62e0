"""The class of ``ros2 param dump``."""

from __future__ import annotations

from typing import Any

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.param.dump import insert
from ros2param.verb import VerbExtension

__all__ = ["PARAMETER_SEPARATOR_STRING", "DumpVerb"]

PARAMETER_SEPARATOR_STRING = "."


class DumpVerb(BuiltinVerb, VerbExtension):
    """Show all parameters of a node as a parameter file."""

    _module = "param.dump"

    def insert_dict(self, dictionary: dict[str, Any], key: str, value: Any) -> None:
        """Put a value into nested dictionaries, one for each part of a dotted name."""
        insert(dictionary, key.split(PARAMETER_SEPARATOR_STRING), value)
