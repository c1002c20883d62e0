"""``ros2 param delete``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from ros2cli.direct_node import DirectNode
from ros2cli.parameters import RemoteParameters, add_node_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_node_arguments(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")


def main(args: argparse.Namespace) -> None:
    """Delete it, and print the result."""
    with DirectNode(args) as direct:
        parameters = RemoteParameters(direct, args)
        (result,) = parameters.delete([args.parameter_name])
        meant = "" if result.successful else parameters.meant(args.parameter_name)
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"Deleted parameter successfully{reason}")
    else:
        print(f"Deleting parameter failed{reason}{meant}", file=sys.stderr)
