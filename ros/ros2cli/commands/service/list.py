"""``ros2 service list``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.discovery import STRATEGY_ARGUMENTS, GraphNode

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument("-t", "--show-types", action="store_true", help="Show the types too"),
    argument("-c", "--count-services", action="store_true", help="Only show how many there are"),
    argument(
        "--include-hidden-services",
        action="store_true",
        help="Also services with a part that begins with an underscore",
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    from ros2cli.graph import services

    with GraphNode(args.spin_time) as graph:
        found = services(graph, hidden=args.include_hidden_services)
    if args.count_services:
        print(len(found))
        return
    for name, types in found:
        print(f"{name} [{', '.join(types)}]" if args.show_types else name)
