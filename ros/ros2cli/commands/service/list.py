"""``ros2 service list``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.discovery import GraphNode, add_strategy_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_strategy_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Show the types too")
    parser.add_argument(
        "-c", "--count-services", action="store_true", help="Only show how many there are"
    )
    parser.add_argument(
        "--include-hidden-services",
        action="store_true",
        help="Also services with a part that begins with an underscore",
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
