"""The class of ``ros2 lifecycle get``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2lifecycle.verb import VerbExtension

__all__ = ["GetVerb"]


class GetVerb(BuiltinVerb, VerbExtension):
    """Show the state of managed nodes."""

    _module = "lifecycle.get"
