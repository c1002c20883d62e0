"""The class of ``ros2 topic find``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2topic.verb import VerbExtension

__all__ = ["FindVerb"]


class FindVerb(BuiltinVerb, VerbExtension):
    """List the topics of a type."""

    _module = "topic.find"
