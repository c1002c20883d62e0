"""``ros2 lifecycle set``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, timeout_argument
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2lifecycle.api import HIDDEN_ARGUMENT, ask, managed_node_names, require_managed_node
from ros2lifecycle.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    HIDDEN_ARGUMENT,
    timeout_argument(),
    argument("node_name", help="Full name of the node", completer=managed_node_names),
    argument(
        "transition",
        help="Label or number of a transition that the node offers, for example configure",
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Ask for the transition, and print how it went."""
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions

    with DirectNode(args) as direct:
        name = require_managed_node(direct.graph, args)
        answer = ask(
            direct,
            GetAvailableTransitions,
            f"{name}/get_available_transitions",
            GetAvailableTransitions.Request(),
            args.timeout,
        )
        offered = [item.transition for item in answer.available_transitions]
        chosen = next(
            (item for item in offered if args.transition in (item.label, str(item.id))), None
        )
        if chosen is None:
            known = "".join(f"\n- {item.label} [{item.id}]" for item in offered)
            return f"Unknown transition requested, available ones are:{known}"
        request = ChangeState.Request(transition=Transition(id=chosen.id, label=chosen.label))
        service = f"{name}/change_state"
        if not ask(direct, ChangeState, service, request, args.timeout).success:
            # As in ROS 2, this is not a failure of the command.
            tell("Transitioning failed")
            return None
    print("Transitioning successful")
    return None


class SetVerb(VerbExtension, module=__name__):
    """Have a managed node change its state."""
