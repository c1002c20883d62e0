"""``ros2 topic list``."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.listing import SHOW_TYPES, count_argument, hidden_argument, print_names_and_types
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    from ros2cli.graph import NamesAndTypes
    from turtlewire.wire.base import Graph

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    SHOW_TYPES,
    count_argument("topic"),
    hidden_argument("topic"),
    argument("-v", "--verbose", action="store_true", help="Show how many publish and subscribe"),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> None:
    """Print names, or what was asked for."""
    from ros2cli.graph import topics

    with discovered_graph(args.spin_time) as graph:
        found = topics(graph, hidden=args.include_hidden_topics)
        if args.verbose and not args.count:
            show = _print_verbose_json if args.json else _print_verbose
            show(graph, found)
        else:
            print_names_and_types("topic", found, args)


def _print_verbose(graph: Graph, found: NamesAndTypes) -> None:
    from ros2cli.graph import endpoints_of_topic

    info = [
        (
            name,
            types,
            len(endpoints_of_topic(graph, name, "publisher")),
            len(endpoints_of_topic(graph, name, "subscription")),
        )
        for name, types in found
    ]
    for is_publisher in (True, False):
        print(ListVerb.show_topic_info(info, is_publisher))


def _print_verbose_json(graph: Graph, found: NamesAndTypes) -> None:
    from ros2cli.graph import endpoints_of_topic

    for name, types in found:
        print_json(
            {
                "topic": name,
                "types": types,
                "publisher_count": len(endpoints_of_topic(graph, name, "publisher")),
                "subscription_count": len(endpoints_of_topic(graph, name, "subscription")),
            }
        )


class ListVerb(VerbExtension, module=__name__):
    """List the topics."""

    @staticmethod
    def show_topic_info(
        topic_info: Iterable[tuple[str, Sequence[str], int, int]], is_publisher: bool
    ) -> str:
        """Return a line for each topic that is published, or subscribed to, below a title.

        Args:
            topic_info: Names and types of topics, and how many publish them and subscribe to them.
            is_publisher: Whether the publishers are meant.
        """
        title, word = ("Published", "publisher") if is_publisher else ("Subscribed", "subscriber")
        lines = [f"{title} topics:"]
        for name, types, publishers, subscribers in topic_info:
            count = publishers if is_publisher else subscribers
            if count:
                plural = "" if count == 1 else "s"
                lines.append(f" * {name} [{', '.join(types)}] {count} {word}{plural}")
        return "".join(f"{line}\n" for line in lines)
