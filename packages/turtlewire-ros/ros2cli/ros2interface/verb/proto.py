"""The class of ``ros2 interface proto``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2interface.verb import VerbExtension

__all__ = ["ProtoVerb"]


class ProtoVerb(BuiltinVerb, VerbExtension):
    """Show an interface as YAML to fill in."""

    _module = "interface.proto"
