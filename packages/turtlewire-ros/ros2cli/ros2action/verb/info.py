"""``ros2 action info``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2action.verb import VerbExtension
from ros2cli.arguments import argument
from ros2cli.completion import action_names
from ros2cli.discovery import discovered_graph
from ros2cli.json_lines import JSON_ARGUMENT, print_json, with_types

if TYPE_CHECKING:
    from ros2cli.graph import NamesAndTypes

ARGUMENTS = (
    argument(
        "action_name",
        help="Name of the action, for example /turtle1/rotate_absolute",
        completer=action_names,
    ),
    argument("-t", "--show-types", action="store_true", help="Also show the types"),
    argument("-c", "--count", action="store_true", help="Show only their number"),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> None:
    """Print clients and servers."""
    from ros2cli.graph import action_nodes, actions
    from ros2cli.suggestion import say_what_was_meant

    with discovered_graph() as graph:
        sides = {"clients": "subscription", "servers": "publisher"}
        found = {side: action_nodes(graph, args.action_name, kind) for side, kind in sides.items()}
        known = dict(actions(graph))
    if args.json:
        _print_json(found, args)
    else:
        _print_text(found, args)
    say_what_was_meant(args.action_name, known)


def _print_text(found: dict[str, NamesAndTypes], args: argparse.Namespace) -> None:
    print(f"Action: {args.action_name}")
    for side, nodes in found.items():
        print(f"Action {side}: {len(nodes)}")
        for name, types in () if args.count else nodes:
            print(f"    {name} [{', '.join(types)}]" if args.show_types else f"    {name}")


def _print_json(found: dict[str, NamesAndTypes], args: argparse.Namespace) -> None:
    data: dict[str, Any] = {"action": args.action_name}
    for side, nodes in found.items():
        data[f"{side.removesuffix('s')}_count"] = len(nodes)
        if not args.count:
            data[side] = with_types("node", nodes)
    print_json(data)


class InfoVerb(VerbExtension, module=__name__):
    """Show who offers and may start an action."""
