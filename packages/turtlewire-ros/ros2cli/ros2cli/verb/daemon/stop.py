"""The verb class of ``ros2 daemon stop``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2cli.verb.daemon import VerbExtension

__all__ = ["StopVerb"]


class StopVerb(BuiltinVerb, VerbExtension):
    """Show that no daemon is running."""

    _module = "daemon.stop"
