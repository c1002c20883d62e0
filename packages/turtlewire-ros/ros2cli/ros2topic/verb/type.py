"""``ros2 topic type``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import topic_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.helpers import OPTIONAL, select_topic
from ros2cli.listing import print_types
from ros2topic.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "topic_name",
        nargs=OPTIONAL,
        help="Name of the topic, for example /tf",
        completer=topic_names,
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the type; status 1 if there is no such topic."""
    from ros2cli.graph import topics

    with discovered_graph(args.spin_time) as graph:
        name = args.topic_name or select_topic(graph, "Select topic for type:")
        known = dict(topics(graph, hidden=True))
    return 0 if name is None else print_types("topic", name, known)


class TypeVerb(VerbExtension, module=__name__):
    """Show the type of a topic."""
