"""``ros2 param describe``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2param.parameters import TYPE_NAMES, RemoteParameters, node_arguments, parameter_names
from ros2param.verb import VerbExtension

ARGUMENTS = (
    *node_arguments(),
    argument(
        "parameter_names", nargs="+", help="Names of the parameters", completer=parameter_names
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print what the node says of them."""
    with DirectNode(args) as direct:
        parameters = RemoteParameters(direct, args)
        descriptors = parameters.descriptors(args.parameter_names)
        described = {descriptor.name for descriptor in descriptors}
        meant = "".join(
            parameters.meant(name) for name in args.parameter_names if name not in described
        )
    for descriptor in descriptors:
        _print(descriptor)
    if meant:
        tell(meant.lstrip("\n"))


def _print(descriptor: Any) -> None:
    print(f"Parameter name: {descriptor.name}\n  Type: {TYPE_NAMES[descriptor.type]}")
    if descriptor.description:
        print(f"  Description: {descriptor.description}")
    print("  Constraints:")
    if descriptor.read_only:
        print("    Read only: true")
    for limits in (*descriptor.integer_range, *descriptor.floating_point_range):
        print(f"    Min value: {limits.from_value}\n    Max value: {limits.to_value}")
        if limits.step:
            print(f"    Step: {limits.step}")
    if descriptor.additional_constraints:
        print(f"    Additional constraints: {descriptor.additional_constraints}")


class DescribeVerb(VerbExtension, module=__name__):
    """Show what a parameter is for, and its limits."""
