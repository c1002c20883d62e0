"""``ros2 service find``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import interfaces
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.listing import count_argument, hidden_argument, print_names_of_type
from ros2service.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "service_type",
        help="Name of the type, for example turtlesim/srv/Spawn",
        completer=interfaces,
    ),
    count_argument("service"),
    hidden_argument("service"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names of the services."""
    from ros2cli.graph import services

    with discovered_graph(args.spin_time) as graph:
        found = services(graph, hidden=args.include_hidden_services)
    print_names_of_type(found, args.service_type, "srv", args)


class FindVerb(VerbExtension, module=__name__):
    """List the services of a type."""
