"""The class of ``ros2 param get``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2param.verb import VerbExtension

__all__ = ["GetVerb"]


class GetVerb(BuiltinVerb, VerbExtension):
    """Show the value of a parameter."""

    _module = "param.get"
