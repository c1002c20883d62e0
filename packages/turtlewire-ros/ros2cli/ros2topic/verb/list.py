"""The class of ``ros2 topic list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2topic.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the topics."""

    _module = "topic.list"
