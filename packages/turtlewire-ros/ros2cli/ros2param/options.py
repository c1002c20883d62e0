"""The options that the verbs of ``ros2 param`` share."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import Argument, argument
from ros2cli.completion import node_names
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.listing import HIDDEN_NODES

_TIMEOUT_S = 5.0


def node_arguments(*, nargs: str | None = None) -> tuple[Argument, ...]:
    """Return the arguments that all verbs of ``ros2 param`` have."""
    return (
        *STRATEGY_ARGUMENTS,
        argument(
            "node_name",
            nargs=nargs,
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
            "--service-timeout",
            metavar="N",
            type=float,
            default=_TIMEOUT_S,
            help="Wait at most N seconds for the node's answer",
        ),
    )


def parameter_names(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the names of the parameters of the node on the command line."""
    from ros2cli.node.direct import DirectNode
    from ros2param.parameters import RemoteParameters

    with DirectNode(parsed_args) as direct:
        return RemoteParameters(direct, parsed_args).names()


NAME_ARGUMENT = argument("parameter_name", help="Name of the parameter", completer=parameter_names)
