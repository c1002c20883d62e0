"""The verb class of ``ros2 daemon status``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2cli.verb.daemon import VerbExtension

__all__ = ["StatusVerb"]


class StatusVerb(BuiltinVerb, VerbExtension):
    """Show that no daemon is running."""

    _module = "daemon.status"
