"""The class of ``ros2 action type``."""

from __future__ import annotations

from ros2action.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["TypeVerb"]


class TypeVerb(BuiltinVerb, VerbExtension):
    """Show the type of an action."""

    _module = "action.type"
