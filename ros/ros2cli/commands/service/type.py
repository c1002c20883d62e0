"""``ros2 service type``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.completion import service_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, GraphNode

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "service_name", help="Name of the service, for example /spawn", completer=service_names
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the type; status 1 when there is no such service."""
    from ros2cli.graph import services
    from ros2cli.suggestion import say_what_was_meant

    with GraphNode(args.spin_time) as graph:
        known = dict(services(graph, hidden=True))
    types = known.get(args.service_name, [])
    for name in types:
        print(name)
    say_what_was_meant(args.service_name, known)
    return 0 if types else 1
