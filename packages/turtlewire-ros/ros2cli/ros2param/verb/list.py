"""``ros2 param list``."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Sequence
from typing import Any

from ros2cli.arguments import argument, regular_expression
from ros2cli.json_lines import JSON_ARGUMENT, print_json, remark_printer
from ros2cli.node.direct import DirectNode
from ros2param.parameters import TYPE_NAMES, ask_all, node_arguments
from ros2param.verb import VerbExtension

ARGUMENTS = (
    *node_arguments(nargs="?"),
    argument(
        "--param-prefixes", nargs="+", default=[], help="Only parameters below these prefixes"
    ),
    argument("--param-type", action="store_true", help="Also show the types"),
    argument(
        "--filter",
        type=regular_expression,
        help="Only parameters whose name matches this regular expression",
    ),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> int:
    """Print the names, below the nodes if none was given; 1 if a node could not be asked."""
    from ros2cli.graph import node_names, require_node

    with DirectNode(args) as direct:
        chosen = args.node_name
        nodes = (
            [require_node(direct.graph, chosen)]
            if chosen
            # Nodes may share a name.
            else dict.fromkeys(node_names(direct.graph, hidden=args.include_hidden_nodes))
        )
        questions = {name: {"prefixes": args.param_prefixes} for name in nodes}
        answers, failed = _ask_all(direct, args, questions, "list_parameters")
        found = {name: _wanted(answer.result.names, args) for name, answer in answers.items()}
        questions = {name: {"names": names} for name, names in found.items()}
        types, failed_types = (
            _ask_all(direct, args, questions, "get_parameter_types")
            if args.param_type
            else ({}, set())
        )
    for name, names in found.items():
        numbers = types[name].types if name in types else ()
        if args.json:
            _print_json(name, names, numbers)
            continue
        if names and not chosen:
            print(f"{name}:")
        for index, parameter in enumerate(names):
            print(f"  {parameter}{f' (type: {TYPE_NAMES[numbers[index]]})' if numbers else ''}")
    return 1 if failed | failed_types else 0


def _wanted(names: list[str], args: argparse.Namespace) -> list[str]:
    return sorted(name for name in names if not args.filter or re.match(args.filter, name))


def _ask_all(
    direct: DirectNode, args: argparse.Namespace, fields: dict[str, dict[str, Any]], service: str
) -> tuple[dict[str, Any], set[str]]:
    """Call `ask_all`, and print which nodes do not have the service."""
    answers, failed = ask_all(direct, fields, service, args.timeout, raises=bool(args.node_name))
    for name in sorted(fields.keys() - answers.keys() - failed):
        _say_that_it_has_none(name, remark_printer(as_json=args.json))
    return answers, failed


def _say_that_it_has_none(node_name: str, remark: Callable[[str], None]) -> None:
    """Print ROS 2's line for a node without parameter services."""
    namespace, _, name = node_name.rpartition("/")
    # ROS 2 prints its named tuple.
    shown = f"NodeName(name='{name}', namespace='{namespace or '/'}', full_name='{node_name}')"
    remark(f"Wait for service timed out waiting for parameter services for node {shown}")


def _print_json(node_name: str, names: list[str], numbers: Sequence[int]) -> None:
    for index, name in enumerate(names):
        type_ = {"type": TYPE_NAMES[numbers[index]]} if numbers else {}
        print_json({"node": node_name, "parameter": name, **type_})


class ListVerb(VerbExtension, module=__name__):
    """List the parameters."""
