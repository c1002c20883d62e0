"""``ros2 param list``."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING

from ros2cli.direct_node import DirectNode
from ros2cli.parameters import TYPE_NAMES, RemoteParameters, add_node_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_node_arguments(parser, optional=True)
    parser.add_argument(
        "--param-prefixes", nargs="+", default=[], help="Only parameters below these prefixes"
    )
    parser.add_argument("--param-type", action="store_true", help="Show the types too")
    parser.add_argument(
        "--filter", help="Only parameters whose name matches this regular expression"
    )


def main(args: argparse.Namespace) -> None:
    """Print the names, below the nodes when none was given."""
    from ros2cli.graph import node_names

    with DirectNode(args) as direct:
        if args.node_name is not None:
            _print(RemoteParameters(direct, args), args)
            return
        for name in dict.fromkeys(node_names(direct.graph, hidden=args.include_hidden_nodes)):
            try:
                remote = RemoteParameters(direct, args, name)
                names = remote.names(args.param_prefixes)
            except RuntimeError as error:
                print(
                    f"Exception while calling list_parameters service of node '{name}': {error}",
                    file=sys.stderr,
                )
                continue
            print(f"{name}:")
            _print(remote, args, names)


def _print(
    remote: RemoteParameters, args: argparse.Namespace, names: list[str] | None = None
) -> None:
    names = remote.names(args.param_prefixes) if names is None else names
    if args.filter:
        names = [name for name in names if re.match(args.filter, name)]
    types = (
        [f" (type: {TYPE_NAMES[number]})" for number in remote.types(names)]
        if args.param_type
        else [""] * len(names)
    )
    for name, kind in zip(names, types, strict=True):
        print(f"  {name}{kind}")
