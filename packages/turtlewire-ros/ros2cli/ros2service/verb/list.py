"""The class of ``ros2 service list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2service.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the services."""

    _module = "service.list"
