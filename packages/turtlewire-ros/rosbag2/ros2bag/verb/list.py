"""The class of ``ros2 bag list``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the storages and compressions that can be used."""

    _module = "bag.list"
