"""``ros2 daemon stop``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.builtin import verb_of_module
from ros2cli.verb.daemon import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["StopVerb", "main"]


def main(_args: argparse.Namespace) -> None:
    """Say that no daemon exists."""
    print("The daemon is not running")


@verb_of_module
class StopVerb(VerbExtension):
    """Show that no daemon is running."""
