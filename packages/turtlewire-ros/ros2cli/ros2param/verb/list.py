"""The class of ``ros2 param list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2param.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the parameters."""

    _module = "param.list"
