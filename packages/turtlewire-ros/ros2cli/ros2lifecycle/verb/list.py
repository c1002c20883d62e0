"""The class of ``ros2 lifecycle list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2lifecycle.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the transitions that a managed node offers."""

    _module = "lifecycle.list"
