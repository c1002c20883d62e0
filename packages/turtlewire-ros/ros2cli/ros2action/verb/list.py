"""``ros2 action list``."""

from __future__ import annotations

import argparse

from ros2action.verb import VerbExtension
from ros2cli.discovery import discovered_graph
from ros2cli.json_lines import JSON_ARGUMENT
from ros2cli.listing import SHOW_TYPES, count_argument, print_names_and_types

ARGUMENTS = (SHOW_TYPES, count_argument("action"), JSON_ARGUMENT)


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    from ros2cli.graph import actions

    with discovered_graph() as graph:
        found = actions(graph)
    print_names_and_types("action", found, args)


class ListVerb(VerbExtension, module=__name__):
    """List the actions."""
