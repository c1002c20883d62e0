"""``ros2 action type``."""

from __future__ import annotations

import argparse

from ros2action.verb import VerbExtension
from ros2cli.arguments import argument
from ros2cli.completion import action_names
from ros2cli.discovery import discovered_graph
from ros2cli.listing import print_types

ARGUMENTS = (
    argument(
        "action_name",
        help="Name of the action, for example /turtle1/rotate_absolute",
        completer=action_names,
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the type; status 1 if there is no such action."""
    from ros2cli.graph import actions

    with discovered_graph() as graph:
        known = dict(actions(graph))
    return print_types("action", args.action_name, known)


class TypeVerb(VerbExtension, module=__name__):
    """Show the type of an action."""
