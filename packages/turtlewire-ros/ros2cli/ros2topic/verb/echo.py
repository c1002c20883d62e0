"""The class of ``ros2 topic echo``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2topic.verb import VerbExtension

__all__ = ["DEFAULT_TRUNCATE_LENGTH", "EchoVerb"]

DEFAULT_TRUNCATE_LENGTH = 128


class EchoVerb(BuiltinVerb, VerbExtension):
    """Show the messages of a topic."""

    _module = "topic.echo"
