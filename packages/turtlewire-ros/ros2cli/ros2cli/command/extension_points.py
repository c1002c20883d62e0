"""``ros2 extension_points``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.command import ModuleCommand
from ros2cli.entry_points import EXTENSION_POINT_GROUP_NAME, described, first_line

__all__ = ["ARGUMENTS", "EXTENSION_POINT_GROUP_NAME", "ExtensionPointsCommand", "main"]


ARGUMENTS = (
    argument(
        "-a",
        "--all",
        action="store_true",
        help="Accepted for compatibility: failures to load are always printed",
    ),
    argument("-v", "--verbose", action="store_true", help="Show where the extensions are"),
)


def main(args: argparse.Namespace) -> None:
    """Print name and description of each extension point."""
    for point, (description, module) in described(EXTENSION_POINT_GROUP_NAME).items():
        _print(args, point, description, module)


def _print(args: argparse.Namespace, name: str, description: str, module: str) -> None:
    print(f"{name}: {description}")
    if args.verbose:
        print(f"  module: {module}")


class ExtensionPointsCommand(ModuleCommand, module=__name__):
    """List the kinds of commands and verbs."""

    def print_extension_point(self, args: argparse.Namespace, name: str, entry_point: Any) -> None:
        """Print name and description of an extension point.

        Args:
            args: ``verbose`` also shows the module.
            name: Name of the group of entry points.
            entry_point: What declares it, with ``load`` and ``module`` as in importlib.metadata.
        """
        _print(args, name, first_line(entry_point.load()), entry_point.module)
