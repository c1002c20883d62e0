"""The class of ``ros2 bag play``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb
from ros2cli.node import NODE_NAME_PREFIX
from ros2cli.values import positive_float

__all__ = ["NODE_NAME_PREFIX", "PlayVerb", "positive_float"]


class PlayVerb(BuiltinVerb, VerbExtension):
    """Publish the messages of a bag at their times."""

    _module = "bag.play"
