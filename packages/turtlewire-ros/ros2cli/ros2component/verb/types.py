"""``ros2 component types``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import packages
from ros2component.verb import VerbExtension

_RESOURCE = "rclcpp_components"


ARGUMENTS = (
    argument(
        "package_name",
        nargs="?",
        help="Name of a package (default: all packages)",
        completer=packages,
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the components below their packages."""
    from ament_index_python import get_resource, get_resources

    registered = get_resources(_RESOURCE)
    if args.package_name is not None and args.package_name not in registered:
        return f"No components registered for package '{args.package_name}'"
    for package in registered if args.package_name is None else [args.package_name]:
        lines = get_resource(_RESOURCE, package)[0].splitlines()
        if args.package_name is None:
            print(package)
        for line in lines:
            indent = "  " if args.package_name is None else ""
            print(f"{indent}{line.partition(';')[0]}")
    return None


class TypesVerb(VerbExtension):
    """List the components that packages have registered."""
