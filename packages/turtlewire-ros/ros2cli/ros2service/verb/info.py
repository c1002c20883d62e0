"""The class of ``ros2 service info``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2service.verb import VerbExtension

__all__ = ["InfoVerb"]


class InfoVerb(BuiltinVerb, VerbExtension):
    """Show how many offer and may call a service."""

    _module = "service.info"
