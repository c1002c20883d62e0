"""The options that the verbs of ``ros2 param`` share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.completion import node_names, parameter_names
from ros2cli.discovery import add_strategy_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["add_name_argument", "add_node_arguments"]

_TIMEOUT_S = 5.0


def add_node_arguments(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """Define what all verbs share."""
    add_strategy_arguments(parser)
    node = parser.add_argument(
        "node_name",
        nargs="?" if optional else None,
        help="Full name of the node, for example /turtlesim",
    )
    node.completer = node_names  # type: ignore[attr-defined]
    parser.add_argument(
        "--include-hidden-nodes",
        action="store_true",
        help="Also nodes whose name begins with an underscore",
    )
    parser.add_argument(
        "--timeout",
        metavar="N",
        type=float,
        default=_TIMEOUT_S,
        help="Wait at most N seconds for the node's answer",
    )


def add_name_argument(parser: argparse.ArgumentParser) -> None:
    """Define the name of one parameter."""
    name = parser.add_argument("parameter_name", help="Name of the parameter")
    name.completer = parameter_names  # type: ignore[attr-defined]
