"""The class of ``ros2 bag record``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb
from ros2cli.node import NODE_NAME_PREFIX

__all__ = ["NODE_NAME_PREFIX", "RecordVerb"]


class RecordVerb(BuiltinVerb, VerbExtension):
    """Record topics and service events into a bag."""

    _module = "bag.record"
