"""``ros2 pkg executables``."""

from __future__ import annotations

import argparse
import os

from ros2cli.arguments import argument
from ros2cli.completion import packages
from ros2pkg.verb import VerbExtension

ARGUMENTS = (
    argument(
        "package_name",
        nargs="?",
        help="Name of the package; all if it is left out",
        completer=packages,
    ),
    argument("--full-path", action="store_true", help="Show the paths"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print package and executable, or the path."""
    from ros2cli.suggestion import package_meant
    from turtlewire_ros.executables import executable_paths

    names = packages() if args.package_name is None else [args.package_name]
    for name in names:
        paths = executable_paths(name)
        if paths is None:
            return f"Package '{name}' not found{package_meant(name)}"
        for path in paths:
            print(path if args.full_path else f"{name} {os.path.basename(path)}")
    return None


class ExecutablesVerb(VerbExtension, module=__name__):
    """List the executables of packages."""
