"""``ros2 extension_points``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension
from ros2cli.installed import EXTENSION_POINT_GROUP_NAME, described

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "ExtensionPointsCommand", "main"]


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
        print(f"{point}: {description}")
        if args.verbose:
            print(f"  module: {module}")


@command_of_module
class ExtensionPointsCommand(CommandExtension):
    """List the kinds of commands and verbs."""
