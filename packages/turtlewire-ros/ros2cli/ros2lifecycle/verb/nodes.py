"""The class of ``ros2 lifecycle nodes``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2lifecycle.verb import VerbExtension

__all__ = ["NodesVerb"]


class NodesVerb(BuiltinVerb, VerbExtension):
    """List the managed nodes."""

    _module = "lifecycle.nodes"
