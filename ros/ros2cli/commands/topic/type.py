"""``ros2 topic type``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.completion import topic_names
from ros2cli.discovery import GraphNode, add_strategy_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_strategy_arguments(parser)
    topic = parser.add_argument("topic_name", help="Name of the topic, for example /tf")
    topic.completer = topic_names  # type: ignore[attr-defined]


def main(args: argparse.Namespace) -> int:
    """Print the type; status 1 when there is no such topic."""
    from ros2cli.graph import topics
    from ros2cli.suggestion import say_what_was_meant

    with GraphNode(args.spin_time) as graph:
        known = dict(topics(graph, hidden=True))
    types = known.get(args.topic_name, [])
    for name in types:
        print(name)
    say_what_was_meant(args.topic_name, known)
    return 0 if types else 1
