"""``ros2 param load``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import files
from ros2cli.node.direct import DirectNode
from ros2cli.output import print_set_results
from ros2param.parameters import RemoteParameters, node_arguments
from ros2param.verb import VerbExtension

ARGUMENTS = (
    *node_arguments(),
    argument("parameter_file", help="Path of the parameter file", completer=files),
    argument(
        "--no-use-wildcard",
        action="store_true",
        help="Ignore the parameters of '/**' (all nodes)",
    ),
)


def main(args: argparse.Namespace) -> None:
    """Set what the file says, and print the results."""
    from rclpy.parameter import parameter_dict_from_yaml_file

    with DirectNode(args) as direct:
        remote = RemoteParameters(direct, args)
        parameters = list(
            parameter_dict_from_yaml_file(args.parameter_file, not args.no_use_wildcard).values()
        )
        results = remote.set(parameters)
    print_set_results(parameters, results)


class LoadVerb(VerbExtension, module=__name__):
    """Set the parameters of a node from a file."""
