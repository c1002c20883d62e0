"""The class of ``ros2 action info``."""

from __future__ import annotations

from ros2action.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["InfoVerb"]


class InfoVerb(BuiltinVerb, VerbExtension):
    """Show who offers and may start an action."""

    _module = "action.info"
