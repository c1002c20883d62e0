"""The class of ``ros2 component load``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2component.verb import VerbExtension

__all__ = ["LoadVerb"]


class LoadVerb(BuiltinVerb, VerbExtension):
    """Load a node into a container."""

    _module = "component.load"
