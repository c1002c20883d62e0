"""``ros2 lifecycle get``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, timeout_argument
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell_failed_call
from ros2lifecycle.api import (
    DEFAULT_TIMEOUT_S,
    HIDDEN_ARGUMENT,
    ask,
    managed_node_names,
    managed_nodes,
    require_managed_node,
)
from ros2lifecycle.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    HIDDEN_ARGUMENT,
    timeout_argument(DEFAULT_TIMEOUT_S),
    argument(
        "node_name",
        nargs="?",
        help="Full name of the node; all if it is left out",
        completer=managed_node_names,
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print label and number of the state; returns 1 if a node could not be asked."""
    from lifecycle_msgs.srv import GetState

    status = 0
    with DirectNode(args) as direct:
        one = None if args.node_name is None else require_managed_node(direct.graph, args)
        for name in (
            managed_nodes(direct.graph, hidden=args.include_hidden_nodes) if one is None else [one]
        ):
            try:
                service, request = f"{name}/get_state", GetState.Request()
                answer = ask(direct, GetState, service, request, args.timeout)
            except RuntimeError as error:
                if one:
                    raise
                tell_failed_call(name, error)
                status = 1
                continue
            state = answer.current_state
            print(f"{'' if one else f'{name}: '}{state.label} [{state.id}]")
    return status


class GetVerb(VerbExtension, module=__name__):
    """Show the state of managed nodes."""
