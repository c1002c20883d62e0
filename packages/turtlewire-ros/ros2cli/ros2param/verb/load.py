"""The class of ``ros2 param load``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2param.verb import VerbExtension

__all__ = ["LoadVerb"]


class LoadVerb(BuiltinVerb, VerbExtension):
    """Set the parameters of a node from a file."""

    _module = "param.load"
