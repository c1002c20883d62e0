"""``ros2 service list``."""

from __future__ import annotations

import argparse

from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.json_lines import JSON_ARGUMENT
from ros2cli.listing import SHOW_TYPES, count_argument, hidden_argument, print_names_and_types
from ros2service.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    SHOW_TYPES,
    count_argument("service"),
    hidden_argument("service"),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    from ros2cli.graph import services

    with discovered_graph(args.spin_time) as graph:
        found = services(graph, hidden=args.include_hidden_services)
    print_names_and_types("service", found, args)


class ListVerb(VerbExtension, module=__name__):
    """List the services."""
