"""``ros2 service info``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import service_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2service.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "InfoVerb", "main"]


ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "service_name", help="Name of the service, for example /spawn", completer=service_names
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Print type and counts."""
    from ros2cli.graph import endpoints_of_topic, services
    from ros2cli.suggestion import did_you_mean
    from turtlewire.wire.names import request_topic

    with discovered_graph(args.spin_time) as graph:
        known = dict(services(graph, hidden=True))
        if args.service_name not in known:
            return f"Unknown service '{args.service_name}'{did_you_mean(args.service_name, known)}"
        types = known[args.service_name]
        request = request_topic(args.service_name)
        print(f"Type: {types[0] if len(types) == 1 else types}")
        print(f"Clients count: {len(endpoints_of_topic(graph, request, 'publisher'))}")
        print(f"Services count: {len(endpoints_of_topic(graph, request, 'subscription'))}")
    return None


@verb_of_module
class InfoVerb(VerbExtension):
    """Show how many offer and may call a service."""
