"""The class of ``ros2 param set``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2param.verb import VerbExtension

__all__ = ["SetVerb"]


class SetVerb(BuiltinVerb, VerbExtension):
    """Set a parameter."""

    _module = "param.set"
