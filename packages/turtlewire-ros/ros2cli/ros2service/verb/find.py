"""The class of ``ros2 service find``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2service.verb import VerbExtension

__all__ = ["FindVerb"]


class FindVerb(BuiltinVerb, VerbExtension):
    """List the services of a type."""

    _module = "service.find"
