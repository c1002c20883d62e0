"""The class of ``ros2 component unload``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2component.verb import VerbExtension

__all__ = ["UnloadVerb"]


class UnloadVerb(BuiltinVerb, VerbExtension):
    """Unload a node from a container."""

    _module = "component.unload"
