"""``ros2 param delete``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.direct_node import DirectNode
from ros2cli.output import tell
from ros2cli.parameter_options import add_name_argument, add_node_arguments
from ros2cli.parameters import RemoteParameters

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_node_arguments(parser)
    add_name_argument(parser)


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
        tell(f"Deleting parameter failed{reason}{meant}")
