"""The class of ``ros2 component list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2component.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the containers and the nodes in them."""

    _module = "component.list"
