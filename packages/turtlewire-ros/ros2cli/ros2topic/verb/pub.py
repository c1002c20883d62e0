"""The class of ``ros2 topic pub``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.topic.pub import main
from ros2cli.values import unsigned_int as nonnegative_int
from ros2topic.verb import VerbExtension

__all__ = ["DEFAULT_WAIT_TIME", "PubVerb", "main", "nonnegative_int"]

DEFAULT_WAIT_TIME = 0.1


class PubVerb(BuiltinVerb, VerbExtension):
    """Publish messages to a topic."""

    _module = "topic.pub"
