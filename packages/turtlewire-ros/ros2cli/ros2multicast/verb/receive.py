"""The class of ``ros2 multicast receive``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2multicast.verb import VerbExtension

__all__ = ["ReceiveVerb"]


class ReceiveVerb(BuiltinVerb, VerbExtension):
    """Wait for one datagram."""

    _module = "multicast.receive"
