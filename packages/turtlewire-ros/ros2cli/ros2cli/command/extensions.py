"""``ros2 extensions``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.command import ModuleCommand
from ros2cli.entry_points import EXTENSION_POINT_GROUP_NAME, described, first_line

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
            _print(args, name, summary, module)


def _print(args: argparse.Namespace, name: str, summary: str, module: str) -> None:
    print(f"  {name}: {summary}")
    if args.verbose:
        print(f"    module: {module}")


class ExtensionsCommand(ModuleCommand, module=__name__):
    """List all commands and verbs."""

    def print_entry_point(self, args: argparse.Namespace, dist: Any, entry_point: Any) -> None:
        """Print name and description of an extension.

        Args:
            args: ``verbose`` also shows the module and the distribution.
            dist: The distribution that declares it, as in importlib.metadata; or None.
            entry_point: What declares it, likewise.
        """
        _print(args, entry_point.name, first_line(entry_point.load()), entry_point.module)
        if args.verbose and dist is not None:
            print(f"    distribution: {dist.metadata['Name']} {dist.version}")
