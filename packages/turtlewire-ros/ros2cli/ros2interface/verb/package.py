"""The class of ``ros2 interface package``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2interface.verb import VerbExtension

__all__ = ["PackageVerb"]


class PackageVerb(BuiltinVerb, VerbExtension):
    """List the interfaces of a package."""

    _module = "interface.package"
