"""The class of ``ros2 node list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2node.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the nodes."""

    _module = "node.list"
