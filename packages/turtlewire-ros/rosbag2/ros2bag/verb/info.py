"""The class of ``ros2 bag info``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["InfoVerb"]


class InfoVerb(BuiltinVerb, VerbExtension):
    """Show what a bag holds."""

    _module = "bag.info"
