"""``ros2 param set``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2param.parameters import NAME_ARGUMENT, RemoteParameters, node_arguments, parameter_names
from ros2param.verb import VerbExtension

ARGUMENTS = (
    *node_arguments(),
    NAME_ARGUMENT,
    argument("value", help="Value of the parameter, as YAML"),
    argument(
        "more",
        nargs="*",
        metavar="name value",
        help="Names and values of further parameters",
        completer=parameter_names,
    ),
    argument("--atomic", action="store_true", help="Set all parameters, or none if one is refused"),
)


def main(args: argparse.Namespace) -> str | None:
    """Set them, and print the results."""
    from rcl_interfaces.msg import Parameter
    from rclpy.parameter import get_parameter_value

    words = [args.parameter_name, args.value, *args.more]
    if len(words) % 2:
        return (
            "Parameters must be provided as name/value pairs: name value [name value ...]."
            f" Got {len(words)} argument(s)."
        )
    parameters = [
        Parameter(name=name, value=get_parameter_value(value))
        for name, value in zip(words[::2], words[1::2], strict=True)
    ]
    with DirectNode(args) as direct:
        remote = RemoteParameters(direct, args)
        if args.atomic:
            result = remote.set_atomically(parameters)
            meant = "" if result.successful else "".join(map(remote.meant, words[::2]))
            _print(result, "Set parameters atomically", "Setting parameters atomically", meant)
            return None
        for parameter, result in zip(parameters, remote.set(parameters), strict=True):
            meant = "" if result.successful else remote.meant(parameter.name)
            name = f"{parameter.name}: " if args.more else ""
            _print(result, f"{name}Set parameter", f"{name}Setting parameter", meant)
    return None


def _print(result: Any, done: str, tried: str, meant: str) -> None:
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"{done} successful{reason}")
    else:
        tell(f"{tried} failed{reason}{meant}")


class SetVerb(VerbExtension, module=__name__):
    """Set parameters."""
