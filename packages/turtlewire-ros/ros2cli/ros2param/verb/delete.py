"""The class of ``ros2 param delete``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2param.verb import VerbExtension

__all__ = ["DeleteVerb"]


class DeleteVerb(BuiltinVerb, VerbExtension):
    """Delete a parameter."""

    _module = "param.delete"
