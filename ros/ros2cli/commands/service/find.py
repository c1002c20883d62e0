"""``ros2 service find``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.completion import interfaces
from ros2cli.discovery import STRATEGY_ARGUMENTS, GraphNode

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "service_type",
        help="Name of the type, for example turtlesim/srv/Spawn",
        completer=interfaces,
    ),
    argument("-c", "--count-services", action="store_true", help="Only show how many there are"),
    argument(
        "--include-hidden-services",
        action="store_true",
        help="Also services with a part that begins with an underscore",
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print the names of the services."""
    from ros2cli.graph import services

    with GraphNode(args.spin_time) as graph:
        found = [
            name
            for name, types in services(graph, hidden=args.include_hidden_services)
            if args.service_type in types
        ]
    if args.count_services:
        print(len(found))
    else:
        for name in found:
            print(name)
