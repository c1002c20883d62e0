"""``ros2 daemon start``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.verb.daemon import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "StartVerb", "main"]


ARGUMENTS = (
    argument(
        "-d", "--debug", action="store_true", help="Accepted for compatibility: there is no daemon"
    ),
)


def main(_args: argparse.Namespace) -> None:
    """Say why nothing is started."""
    print("No daemon is needed: every command discovers the nodes by itself")


@verb_of_module
class StartVerb(VerbExtension):
    """Explain that there is no daemon."""
