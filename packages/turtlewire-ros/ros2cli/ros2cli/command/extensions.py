"""``ros2 extensions``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.command._extension_points import extension_points, extensions

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    argument(
        "-a",
        "--all",
        action="store_true",
        help="Accepted for compatibility: those that fail to load are told anyway",
    ),
    argument("-v", "--verbose", action="store_true", help="Show the modules of the extensions"),
)


def main(args: argparse.Namespace) -> None:
    """Print the commands and verbs below their extension points."""
    for point in extension_points():
        found = extensions(point)
        if found:
            print(point.name)
        for name, (summary, module) in found.items():
            print(f"  {name}: {summary}")
            if args.verbose:
                print(f"    module: {module}")
