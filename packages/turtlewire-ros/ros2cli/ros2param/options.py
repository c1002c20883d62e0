"""The options that the verbs of ``ros2 param`` share."""

from __future__ import annotations

from ros2cli.arguments import Argument, argument
from ros2cli.completion import node_names, parameter_names
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.listing import HIDDEN_NODES

__all__ = ["NAME_ARGUMENT", "node_arguments"]

_TIMEOUT_S = 5.0


def node_arguments(*, optional: bool = False) -> tuple[Argument, ...]:
    """Return the arguments that all verbs of ``ros2 param`` have."""
    return (
        *STRATEGY_ARGUMENTS,
        argument(
            "node_name",
            nargs="?" if optional else None,
            help="Full name of the node, for example /turtlesim",
            completer=node_names,
        ),
        argument(
            "--include-hidden-nodes",
            action="store_true",
            help=HIDDEN_NODES,
        ),
        argument(
            "--timeout",
            metavar="N",
            type=float,
            default=_TIMEOUT_S,
            help="Wait at most N seconds for the node's answer",
        ),
    )


NAME_ARGUMENT = argument("parameter_name", help="Name of the parameter", completer=parameter_names)
