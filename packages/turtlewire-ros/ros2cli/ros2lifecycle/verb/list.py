"""``ros2 lifecycle list``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, timeout_argument
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.node.direct import DirectNode
from ros2lifecycle.api import (
    DEFAULT_TIMEOUT_S,
    HIDDEN_ARGUMENT,
    ask,
    managed_node_names,
    require_managed_node,
)
from ros2lifecycle.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    HIDDEN_ARGUMENT,
    timeout_argument(DEFAULT_TIMEOUT_S),
    argument("node_name", help="Full name of the node", completer=managed_node_names),
    argument(
        "-a",
        "--all",
        action="store_true",
        help="All transitions, not only those from the present state",
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print each transition with its start and its goal."""
    from lifecycle_msgs.srv import GetAvailableTransitions

    service = "get_transition_graph" if args.all else "get_available_transitions"
    with DirectNode(args) as direct:
        name = require_managed_node(direct.graph, args)
        request = GetAvailableTransitions.Request()
        answer = ask(direct, GetAvailableTransitions, f"{name}/{service}", request, args.timeout)
    for offered in answer.available_transitions:
        print(f"- {offered.transition.label} [{offered.transition.id}]")
        print(f"\tStart: {offered.start_state.label}\n\tGoal: {offered.goal_state.label}")


class ListVerb(VerbExtension, module=__name__):
    """List the transitions that a managed node offers."""
