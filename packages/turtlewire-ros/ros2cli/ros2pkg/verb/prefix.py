"""The class of ``ros2 pkg prefix``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2pkg.verb import VerbExtension

__all__ = ["PACKAGE_NOT_FOUND", "PrefixVerb"]

PACKAGE_NOT_FOUND = "Package not found"


class PrefixVerb(BuiltinVerb, VerbExtension):
    """Show the prefix that a package is installed in."""

    _module = "pkg.prefix"
