"""The class of ``ros2 pkg create``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2pkg.verb import VerbExtension

__all__ = ["CreateVerb"]


class CreateVerb(BuiltinVerb, VerbExtension):
    """Create a package."""

    _module = "pkg.create"
