"""The class of ``ros2 topic info``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2topic.verb import VerbExtension

__all__ = ["InfoVerb"]


class InfoVerb(BuiltinVerb, VerbExtension):
    """Show who publishes and subscribes to a topic."""

    _module = "topic.info"
