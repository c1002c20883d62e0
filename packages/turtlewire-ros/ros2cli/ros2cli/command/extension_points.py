"""``ros2 extension_points``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.command._extension_points import extension_points

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
    argument("-v", "--verbose", action="store_true", help="Show where the extensions are"),
)


def main(args: argparse.Namespace) -> None:
    """Print name and description of each extension point."""
    for point in extension_points():
        print(f"{point.name}: {point.description}")
        if args.verbose:
            print(f"  module: {point.module}")
