"""``ros2 action find``."""

from __future__ import annotations

import argparse

from ros2action.api import action_type_completer
from ros2action.verb import VerbExtension
from ros2cli.arguments import argument
from ros2cli.discovery import discovered_graph
from ros2cli.listing import count_argument, print_names_of_type

ARGUMENTS = (
    argument(
        "action_type",
        help="Name of the type, for example turtlesim/action/RotateAbsolute",
        completer=action_type_completer,
    ),
    count_argument("action"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names of the actions."""
    from ros2cli.graph import actions

    with discovered_graph() as graph:
        found = actions(graph)
    print_names_of_type(found, args.action_type, "action", args)


class FindVerb(VerbExtension, module=__name__):
    """List the actions of a type."""
