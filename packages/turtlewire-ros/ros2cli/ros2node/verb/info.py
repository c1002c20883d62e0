"""``ros2 node info``."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.completion import node_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.helpers import OPTIONAL, select_node
from ros2cli.json_lines import JSON_ARGUMENT, print_json, with_types
from ros2cli.output import tell
from ros2node.verb import VerbExtension

if TYPE_CHECKING:
    from ros2cli.graph import NamesAndTypes
    from turtlewire.wire.base import Graph

INFO_NONUNIQUE_WARNING_TEMPLATE = (
    'There are {num_nodes} nodes in the graph with the exact name "{node_name}". '
    "You are seeing information about only one of them."
)

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "node_name",
        nargs=OPTIONAL,
        help="Full name of the node, for example /turtlesim",
        completer=node_names,
    ),
    argument(
        "--include-hidden",
        action="store_true",
        help="Include topics and services with a name part that starts with an underscore",
    ),
    JSON_ARGUMENT,
)

#: The title of each section, and the key of the names in it.
_SECTIONS = {
    "Subscribers": "topic",
    "Publishers": "topic",
    "Service Servers": "service",
    "Service Clients": "service",
    "Action Servers": "action",
    "Action Clients": "action",
}


def main(args: argparse.Namespace) -> str | None:
    """Print what the node has, kind by kind."""
    from ros2cli import graph as ask
    from ros2cli.suggestion import did_you_mean

    hidden = args.include_hidden
    with discovered_graph(args.spin_time) as graph:
        name = args.node_name or select_node(graph, "Select node for info:")
        if name is None:
            return None
        known = ask.node_names(graph, hidden=hidden)
        if name not in known:
            return f"Unable to find node '{name}'{did_you_mean(name, known)}"
        if known.count(name) > 1:
            tell(
                INFO_NONUNIQUE_WARNING_TEMPLATE.format(num_nodes=known.count(name), node_name=name)
            )
        found = (
            ask.subscribers(graph, name, hidden=hidden),
            ask.publishers(graph, name, hidden=hidden),
            ask.service_servers(graph, name, hidden=hidden),
            ask.service_clients(graph, name, hidden=hidden),
            ask.action_servers(graph, name),
            ask.action_clients(graph, name),
        )
        show = _print_json if args.json else _print_text
        show(name, dict(zip(_SECTIONS, found, strict=True)))
        _say_what_is_not_callable(graph, name)
    return None


def _say_what_is_not_callable(graph: Graph, node_name: str) -> None:
    from ros2cli.graph import foreign_middlewares
    from turtlewire.wire.services import advice

    for middleware in foreign_middlewares(graph, node_name):
        tell(
            f"The services of {node_name}, including parameters and actions, cannot be called "
            f"from here: it runs on {middleware}. {advice('node')}"
        )


def _print_text(node_name: str, sections: dict[str, NamesAndTypes]) -> None:
    print(node_name)
    for title, found in sections.items():
        print(f"  {title}:")
        print_names_and_types(found)


def _print_json(node_name: str, sections: dict[str, NamesAndTypes]) -> None:
    lists = {
        title.lower().replace(" ", "_"): with_types(_SECTIONS[title], found)
        for title, found in sections.items()
    }
    print_json({"node": node_name, **lists})


def print_names_and_types(names_and_types: Iterable[tuple[str, list[str]]]) -> None:
    """Print topics, services or actions with their types, indented; an empty line for none."""
    print(*(f"    {name}: {', '.join(types)}" for name, types in names_and_types), sep="\n")


class InfoVerb(VerbExtension, module=__name__):
    """Show what a node publishes, subscribes to and offers."""
