"""The verb class of ``ros2 daemon start``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2cli.verb.daemon import VerbExtension

__all__ = ["StartVerb"]


class StartVerb(BuiltinVerb, VerbExtension):
    """Explain that there is no daemon."""

    _module = "daemon.start"
