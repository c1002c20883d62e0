"""``ros2 param get``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.helpers import OPTIONAL, interactive_select, select_node
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.node.direct import DirectNode
from ros2param.parameters import (
    TYPE_NAMES,
    RemoteParameters,
    ask_all,
    node_arguments,
    parameter_names,
)
from ros2param.verb import VerbExtension

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
    *node_arguments(nargs=OPTIONAL),
    argument(
        "parameter_names",
        nargs="*",
        help="Names of the parameters; without them, the first word is one, of all nodes",
        completer=parameter_names,
    ),
    argument("--hide-type", action="store_true", help="Show only the value"),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> str | int | None:
    """Print the values."""
    with DirectNode(args) as direct:
        if args.node_name is None:
            args.node_name = select_node(direct.graph, "Select node:")
            if args.node_name is None:
                return "No node selected"
            args.parameter_names = _selected_parameter(direct, args)
            if not args.parameter_names:
                return None
        if not args.parameter_names:
            return _print_of_all_nodes(direct, args, args.node_name)
        remote = RemoteParameters(direct, args)
        names = args.parameter_names
        values = remote.values(names)
        if len(values) < len(names) or not all(value.type in _LABELS for value in values):
            return _missing(names) + "".join(map(remote.meant, names))
    for name, value in zip(names, values, strict=True):
        if args.json:
            _print_json(remote.node_name, name, value)
        elif len(names) == 1:
            print(_text(value, args))
        else:
            print(f"{name}:{_text(value, args, below=True)}")
    return None


def _selected_parameter(direct: DirectNode, args: argparse.Namespace) -> list[str]:
    name = interactive_select(RemoteParameters(direct, args).names(), "Select parameter:")
    return [] if name is None else [name]


def _missing(names: list[str]) -> str:
    """Return ROS 2's text: with an undeclared name, a node answers for none of the names."""
    if len(names) == 1:
        return "Parameter not set"
    return f"Parameter(s) {', '.join(map(repr, names))} not available on node"


def _print_of_all_nodes(direct: DirectNode, args: argparse.Namespace, name: str) -> str | int:
    """Print the value of a parameter of each node that has it; 1 if a node failed."""
    from ros2cli.graph import full_node_name, node_names

    nodes = dict.fromkeys(node_names(direct.graph, hidden=args.include_hidden_nodes))
    questions = {node: {"names": [name]} for node in nodes}
    answers, failed = ask_all(direct, questions, "get_parameters", args.timeout)
    found = {
        node: answers[node].values[0]
        for node in nodes
        if node in answers and answers[node].values and answers[node].values[0].type in _LABELS
    }
    for node, value in found.items():
        if args.json:
            _print_json(node, name, value)
        else:
            print(f"{node}:{_text(value, args, below=True)}")
    if not found:
        node = full_node_name(name)
        hint = f"\n{node} is a node: also name one of its parameters" if node in nodes else ""
        return f"Parameter '{name}' not set on any node{hint}"
    return 1 if failed else 0


def _print_json(node_name: str, parameter_name: str, message: Any) -> None:
    from rclpy.parameter import parameter_value_to_python

    print_json(
        {
            "node": node_name,
            "parameter": parameter_name,
            "type": TYPE_NAMES[message.type],
            "value": parameter_value_to_python(message),
        }
    )


def _text(message: Any, args: argparse.Namespace, *, below: bool = False) -> str:
    """Return a value as text; ``below`` puts it under a name, or beside it without the type."""
    from rclpy.parameter import parameter_value_to_python

    value: Any = parameter_value_to_python(message)
    if args.hide_type:
        return f" {value}" if below else str(value)
    text = f"{_LABELS[message.type]} {value}"
    return f"\n  {text}" if below else text


class GetVerb(VerbExtension, module=__name__):
    """Show the values of parameters."""
