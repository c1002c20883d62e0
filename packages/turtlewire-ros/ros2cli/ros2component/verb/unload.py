"""``ros2 component unload``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, timeout_argument, unsigned_int
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2component.containers import ask, container_node_names, require_container
from ros2component.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    timeout_argument(),
    argument(
        "container_node_name", help="Full name of the container", completer=container_node_names
    ),
    argument("component_uid", type=unsigned_int, nargs="+", help="Numbers of the nodes to unload"),
)


def main(args: argparse.Namespace) -> int:
    """Unload the nodes; status 1 if one of them is not there."""
    from composition_interfaces.srv import UnloadNode

    status = 0
    with DirectNode(args) as direct:
        container = require_container(direct.graph, args.container_node_name)
        for number in args.component_uid:
            request = UnloadNode.Request(unique_id=number)
            answer = ask(direct, container, "unload_node", UnloadNode, request, args.timeout)
            if answer.success:
                print(f"Unloaded component {number} from '{container}' container node")
            else:
                status = 1
                tell(f"Failed to unload component {number} from '{container}' container node")
                tell(f"    {answer.error_message}")
    return status


class UnloadVerb(VerbExtension, module=__name__):
    """Unload a node from a container."""
