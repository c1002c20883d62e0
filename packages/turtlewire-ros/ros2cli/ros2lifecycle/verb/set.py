"""The class of ``ros2 lifecycle set``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2lifecycle.verb import VerbExtension

__all__ = ["SetVerb"]


class SetVerb(BuiltinVerb, VerbExtension):
    """Have a managed node change its state."""

    _module = "lifecycle.set"
