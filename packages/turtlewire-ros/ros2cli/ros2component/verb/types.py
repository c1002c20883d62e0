"""``ros2 component types``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import packages
from ros2component.verb import VerbExtension

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
    from ros2component import api

    chosen = args.package_name
    registered = api.get_package_names_with_component_types()
    if chosen is not None and chosen not in registered:
        return f"No components registered for package '{chosen}'"
    for package in registered if chosen is None else [chosen]:
        if chosen is None:
            print(package)
        for name in api.get_package_component_types(package_name=package):
            print(f"  {name}" if chosen is None else name)
    return None


class TypesVerb(VerbExtension, module=__name__):
    """List the components that packages have registered."""
