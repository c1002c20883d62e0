"""``ros2 service type``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import service_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.json_lines import JSON_ARGUMENT
from ros2cli.listing import print_types
from ros2service.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "service_name", help="Name of the service, for example /spawn", completer=service_names
    ),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> int:
    """Print the type; status 1 if there is no such service."""
    from ros2cli.graph import services

    with discovered_graph(args.spin_time) as graph:
        known = dict(services(graph, hidden=True))
    return print_types("service", args.service_name, known, as_json=args.json)


class TypeVerb(VerbExtension, module=__name__):
    """Show the type of a service."""
