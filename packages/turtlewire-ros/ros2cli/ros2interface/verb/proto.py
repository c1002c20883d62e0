"""``ros2 interface proto``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import interfaces
from ros2interface.verb import VerbExtension

ARGUMENTS = (
    argument(
        "type",
        help="Name of the interface, for example geometry_msgs/msg/Twist",
        completer=interfaces,
    ),
    argument("--no-quotes", action="store_true", help="Without the quotes that a shell needs"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the default values as YAML."""
    from ros2interface.api import interface_to_yaml

    try:
        text = interface_to_yaml(args.type)
    except (AttributeError, ModuleNotFoundError, ValueError) as error:
        from ros2cli.suggestion import interface_meant

        return f"{type(error).__name__}: {error}{interface_meant(args.type)}"
    print(text if args.no_quotes else f'"{text}"')
    return None


class ProtoVerb(VerbExtension, module=__name__):
    """Show an interface as YAML to fill in."""
