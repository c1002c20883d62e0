"""The class of ``ros2 service type``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2service.verb import VerbExtension

__all__ = ["TypeVerb"]


class TypeVerb(BuiltinVerb, VerbExtension):
    """Show the type of a service."""

    _module = "service.type"
