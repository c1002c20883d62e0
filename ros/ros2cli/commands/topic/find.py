"""``ros2 topic find``."""

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
        "topic_type",
        help="Name of the type, for example tf2_msgs/msg/TFMessage",
        completer=interfaces,
    ),
    argument("-c", "--count-topics", action="store_true", help="Only show how many there are"),
    argument(
        "--include-hidden-topics",
        action="store_true",
        help="Also topics with a part that begins with an underscore",
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print the names of the topics."""
    from ros2cli.graph import topics

    with GraphNode(args.spin_time) as graph:
        found = [
            name
            for name, types in topics(graph, hidden=args.include_hidden_topics)
            if args.topic_type in types
        ]
    if args.count_topics:
        print(len(found))
    else:
        for name in found:
            print(name)
