"""``ros2 pkg prefix``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import packages
from ros2pkg.verb import VerbExtension

PACKAGE_NOT_FOUND = "Package not found"

ARGUMENTS = (
    argument("package_name", help="Name of the package", completer=packages),
    argument("--share", action="store_true", help="Show the folder with its data instead"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the folder."""
    from ros2cli.suggestion import package_meant
    from turtlewire_ros.prefix import package_prefix, share_directory

    folder = (share_directory if args.share else package_prefix)(args.package_name)
    if folder is None:
        return f"{PACKAGE_NOT_FOUND}{package_meant(args.package_name)}"
    print(folder)
    return None


class PrefixVerb(VerbExtension, module=__name__):
    """Show the prefix that a package is installed in."""
