"""The class of ``ros2 interface show``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2interface.verb import VerbExtension

__all__ = ["ShowVerb"]


class ShowVerb(BuiltinVerb, VerbExtension):
    """Show the definition of an interface."""

    _module = "interface.show"
