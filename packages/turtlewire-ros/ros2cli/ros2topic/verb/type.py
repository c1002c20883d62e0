"""The class of ``ros2 topic type``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2topic.verb import VerbExtension

__all__ = ["TypeVerb"]


class TypeVerb(BuiltinVerb, VerbExtension):
    """Show the type of a topic."""

    _module = "topic.type"
