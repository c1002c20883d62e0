"""The class of ``ros2 bag convert``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["ConvertVerb"]


class ConvertVerb(BuiltinVerb, VerbExtension):
    """Write the messages of bags into others."""

    _module = "bag.convert"
