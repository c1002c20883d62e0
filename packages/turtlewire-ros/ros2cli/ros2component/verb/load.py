"""``ros2 component load``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, timeout_argument
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.node.direct import DirectNode
from ros2component.containers import (
    COMPONENT_ARGUMENTS,
    ask,
    container_node_names,
    load_request,
    require_container,
)
from ros2component.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    timeout_argument(),
    argument(
        "container_node_name", help="Full name of the container", completer=container_node_names
    ),
    *COMPONENT_ARGUMENTS,
    argument("-q", "--quiet", action="store_true", help="Print only the node's number"),
)


def main(args: argparse.Namespace) -> str | None:
    """Load the node, and print its number and name."""
    from composition_interfaces.srv import LoadNode

    with DirectNode(args) as direct:
        container = require_container(direct.graph, args.container_node_name)
        request = load_request(args)
        answer = ask(direct, container, "load_node", LoadNode, request, args.timeout)
    if not answer.success:
        return f"Failed to load component: {answer.error_message}"
    if args.quiet:
        print(answer.unique_id)
    else:
        print(
            f"Loaded component {answer.unique_id} into '{container}' container node as "
            f"'{answer.full_node_name}'"
        )
    return None


class LoadVerb(VerbExtension, module=__name__):
    """Load a node into a container."""
