"""The class of ``ros2 pkg executables``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2pkg.verb import VerbExtension

__all__ = ["ExecutablesVerb"]


class ExecutablesVerb(BuiltinVerb, VerbExtension):
    """List the executables of packages."""

    _module = "pkg.executables"
