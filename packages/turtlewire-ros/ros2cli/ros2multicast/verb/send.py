"""The class of ``ros2 multicast send``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2multicast.verb import VerbExtension

__all__ = ["SendVerb"]


class SendVerb(BuiltinVerb, VerbExtension):
    """Send one datagram."""

    _module = "multicast.send"
