"""``ros2 extension_points``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.extension_points import EXTENSION_POINTS, extensions

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    parser.add_argument(
        "-a",
        "--all",
        action="store_true",
        help="Accepted for compatibility: no extension fails to load",
    )
    parser.add_argument(
        "-v", "--verbose", action="store_true", help="Show where the extensions are"
    )


def main(args: argparse.Namespace) -> None:
    """Print name and description of each extension point."""
    for name, command, description in EXTENSION_POINTS:
        if extensions(command):
            print(f"{name}: {description}")
            if args.verbose:
                print(f"  module: ros2cli.commands{f'.{command}' if command else ''}")
