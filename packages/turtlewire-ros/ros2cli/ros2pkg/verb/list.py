"""The class of ``ros2 pkg list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2pkg.verb import VerbExtension

__all__ = ["ListVerb"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List the installed packages."""

    _module = "pkg.list"
