"""The class of ``ros2 component standalone``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2component.verb import VerbExtension

__all__ = ["StandaloneVerb"]


class StandaloneVerb(BuiltinVerb, VerbExtension):
    """Run a node in a container of its own."""

    _module = "component.standalone"
