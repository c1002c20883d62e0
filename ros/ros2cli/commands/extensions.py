"""``ros2 extensions``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.commands._extension_points import EXTENSION_POINTS, extensions

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    argument(
        "-a",
        "--all",
        action="store_true",
        help="Accepted for compatibility: no extension fails to load",
    ),
    argument("-v", "--verbose", action="store_true", help="Show the modules of the extensions"),
)


def main(args: argparse.Namespace) -> None:
    """Print the commands and verbs below their extension points."""
    for point, command, _ in EXTENSION_POINTS:
        found = extensions(command)
        if found:
            print(point)
        for name, summary in found.items():
            print(f"  {name}: {summary}")
            if args.verbose:
                path = f"{command}.{name}" if command else name
                print(f"    module: ros2cli.commands.{path}")
