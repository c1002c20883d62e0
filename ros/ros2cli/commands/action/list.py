"""``ros2 action list``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.discovery import GraphNode

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    argument("-t", "--show-types", action="store_true", help="Show the types too"),
    argument("-c", "--count-actions", action="store_true", help="Only show how many there are"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    from ros2cli.graph import actions

    with GraphNode() as graph:
        found = actions(graph)
    if args.count_actions:
        print(len(found))
        return
    for name, types in found:
        print(f"{name} [{', '.join(types)}]" if args.show_types else name)
