"""``ros2 node list``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph, hidden_node_name
from ros2cli.json_lines import JSON_ARGUMENT, print_json_list
from ros2cli.listing import HIDDEN_NODES, count_argument, print_names
from ros2cli.output import tell
from ros2node.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument("-a", "--all", action="store_true", help=HIDDEN_NODES),
    count_argument("node"),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> None:
    """Print the full names."""
    from ros2cli.graph import node_names

    with discovered_graph(args.spin_time) as graph:
        names = node_names(graph, hidden=args.all)
    if not args.no_daemon:  # ROS 2 asks its daemon then, where the command has no node
        names = [name for name in names if name != f"/{hidden_node_name()}"]
    if len(set(names)) < len(names) and not args.count:
        tell(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, "
            "which can have unintended side effects."
        )
    if args.json:
        print_json_list([{"node": name} for name in names], args)
    else:
        print_names(names, args)


class ListVerb(VerbExtension, module=__name__):
    """List the nodes."""
