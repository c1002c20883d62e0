"""``ros2 lifecycle nodes``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.listing import HIDDEN_NODES, count_argument, print_names
from ros2lifecycle.api import managed_nodes
from ros2lifecycle.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "-a",
        "--all",
        "--include-hidden-nodes",
        action="store_true",
        help=HIDDEN_NODES,
    ),
    count_argument("node"),
)


def main(args: argparse.Namespace) -> None:
    """Print the full names."""
    with discovered_graph(args.spin_time) as graph:
        names = managed_nodes(graph, hidden=args.all)
    print_names(names, args)


class NodesVerb(VerbExtension, module=__name__):
    """List the managed nodes."""
