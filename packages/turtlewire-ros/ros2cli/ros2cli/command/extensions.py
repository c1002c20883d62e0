"""``ros2 extensions``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension
from ros2cli.installed import EXTENSION_POINT_GROUP_NAME, described

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "ExtensionsCommand", "main"]


ARGUMENTS = (
    argument(
        "-a",
        "--all",
        action="store_true",
        help="Accepted for compatibility: failures to load are always printed",
    ),
    argument("-v", "--verbose", action="store_true", help="Show the modules of the extensions"),
)


def main(args: argparse.Namespace) -> None:
    """Print the commands and verbs below their extension points."""
    for point in described(EXTENSION_POINT_GROUP_NAME):
        found = described(point)
        if found:
            print(point)
        for name, (summary, module) in found.items():
            print(f"  {name}: {summary}")
            if args.verbose:
                print(f"    module: {module}")


@command_of_module
class ExtensionsCommand(CommandExtension):
    """List all commands and verbs."""
