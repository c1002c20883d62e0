"""The class of ``ros2 interface packages``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.builtin import BuiltinVerb
from ros2interface.verb import VerbExtension

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["PackagesVerb", "print_packages"]


class PackagesVerb(BuiltinVerb, VerbExtension):
    """List the packages that have interfaces."""

    _module = "interface.packages"


def print_packages(packs: Iterable[str]) -> None:
    """Print names, one on each line."""
    for name in packs:
        print(name)
