"""The class of ``ros2 action list``."""

from __future__ import annotations

from ros2action.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the actions."""

    _module = "action.list"
