"""The class of ``ros2 component types``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2component.verb import VerbExtension

__all__ = ["TypesVerb"]


class TypesVerb(BuiltinVerb, VerbExtension):
    """List the components that packages have registered."""

    _module = "component.types"
