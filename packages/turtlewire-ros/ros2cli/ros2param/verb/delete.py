"""``ros2 param delete``."""

from __future__ import annotations

import argparse

from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2param.parameters import NAME_ARGUMENT, RemoteParameters, node_arguments
from ros2param.verb import VerbExtension

ARGUMENTS = (*node_arguments(), NAME_ARGUMENT)


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


class DeleteVerb(VerbExtension, module=__name__):
    """Delete a parameter."""
