"""``ros2 topic find``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import interfaces
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.listing import count_argument, hidden_argument, print_names_of_type
from ros2topic.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "topic_type",
        help="Name of the type, for example tf2_msgs/msg/TFMessage",
        completer=interfaces,
    ),
    count_argument("topic"),
    hidden_argument("topic"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names of the topics."""
    from ros2cli.graph import topics

    with discovered_graph(args.spin_time) as graph:
        found = topics(graph, hidden=args.include_hidden_topics)
    print_names_of_type(found, args.topic_type, "msg", args)


class FindVerb(VerbExtension, module=__name__):
    """List the topics of a type."""
