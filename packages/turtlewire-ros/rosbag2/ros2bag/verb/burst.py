"""The class of ``ros2 bag burst``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb
from ros2cli.node import NODE_NAME_PREFIX

__all__ = ["NODE_NAME_PREFIX", "BurstVerb"]


class BurstVerb(BuiltinVerb, VerbExtension):
    """Publish the first messages of a bag at once."""

    _module = "bag.burst"
