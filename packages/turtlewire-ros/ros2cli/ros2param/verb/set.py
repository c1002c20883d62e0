"""``ros2 param set``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2param.options import NAME_ARGUMENT, node_arguments
from ros2param.parameters import RemoteParameters
from ros2param.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "SetVerb", "main"]


ARGUMENTS = (
    *node_arguments(),
    NAME_ARGUMENT,
    argument("value", help="Value of the parameter, as YAML"),
)


def main(args: argparse.Namespace) -> None:
    """Set it, and print the result."""
    from rcl_interfaces.msg import Parameter
    from rclpy.parameter import get_parameter_value

    parameter = Parameter(name=args.parameter_name, value=get_parameter_value(args.value))
    with DirectNode(args) as direct:
        parameters = RemoteParameters(direct, args)
        (result,) = parameters.set([parameter])
        meant = "" if result.successful else parameters.meant(args.parameter_name)
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"Set parameter successful{reason}")
    else:
        tell(f"Setting parameter failed{reason}{meant}")


@verb_of_module
class SetVerb(VerbExtension):
    """Set a parameter."""
