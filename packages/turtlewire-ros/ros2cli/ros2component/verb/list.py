"""``ros2 component list``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, timeout_argument
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell_failed_call
from ros2component.containers import (
    LIST_TIMEOUT_S,
    ask,
    container_names,
    container_node_names,
    require_container,
)
from ros2component.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    timeout_argument(LIST_TIMEOUT_S),
    argument(
        "container_node_name",
        nargs="?",
        help="Full name of a container (default: all containers)",
        completer=container_node_names,
    ),
    argument(
        "--containers-only", action="store_true", help="Show the containers without their nodes"
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the containers with number and name of each node in them; 1 if one did not answer."""
    from composition_interfaces.srv import ListNodes

    status = 0
    with DirectNode(args) as direct:
        chosen = args.container_node_name
        names = [require_container(direct.graph, chosen)] if chosen else []
        for name in names or container_names(direct.graph):
            if not chosen:
                print(name)
            if args.containers_only:
                continue
            try:
                request = ListNodes.Request()
                answer = ask(direct, name, "list_nodes", ListNodes, request, args.timeout)
            except RuntimeError as error:
                if chosen:
                    raise
                tell_failed_call(name, error)
                status = 1
                continue
            indent = "" if chosen else "  "
            for number, node in zip(answer.unique_ids, answer.full_node_names, strict=True):
                print(f"{indent}{number}  {node}")
    return status


class ListVerb(VerbExtension, module=__name__):
    """List the containers and the nodes in them."""
