"""``ros2 param get``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.node.direct import DirectNode
from ros2param.options import NAME_ARGUMENT, node_arguments
from ros2param.parameters import RemoteParameters
from ros2param.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "GetVerb", "main"]

_LABELS = {
    1: "Boolean value is:",
    2: "Integer value is:",
    3: "Double value is:",
    4: "String value is:",
    5: "Byte values are:",
    6: "Boolean values are:",
    7: "Integer values are:",
    8: "Double values are:",
    9: "String values are:",
}


ARGUMENTS = (
    *node_arguments(),
    NAME_ARGUMENT,
    argument("--hide-type", action="store_true", help="Show only the value"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the value."""
    from rclpy.parameter import parameter_value_to_python

    with DirectNode(args) as direct:
        parameters = RemoteParameters(direct, args)
        values = parameters.values([args.parameter_name])
        if not values or values[0].type not in _LABELS:
            return f"Parameter not set{parameters.meant(args.parameter_name)}"
    value: Any = parameter_value_to_python(values[0])
    shown = list(value) if hasattr(value, "typecode") else value
    print(shown if args.hide_type else f"{_LABELS[values[0].type]} {shown}")
    return None


@verb_of_module
class GetVerb(VerbExtension):
    """Show the value of a parameter."""
