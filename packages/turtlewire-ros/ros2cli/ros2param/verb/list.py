"""``ros2 param list``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell_failed_call
from ros2cli.values import regular_expression
from ros2param.options import node_arguments
from ros2param.parameters import TYPE_NAMES, Question
from ros2param.verb import VerbExtension

if TYPE_CHECKING:
    import argparse
    from collections.abc import Collection

__all__ = ["ARGUMENTS", "ListVerb", "main"]


ARGUMENTS = (
    *node_arguments(optional=True),
    argument(
        "--param-prefixes", nargs="+", default=[], help="Only parameters below these prefixes"
    ),
    argument("--param-type", action="store_true", help="Also show the types"),
    argument(
        "--filter",
        type=regular_expression,
        help="Only parameters whose name matches this regular expression",
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the names, below the nodes if none was given; 1 if a node could not be asked."""
    from ros2cli.graph import node_names, require_node

    with DirectNode(args) as direct:
        chosen = args.node_name
        nodes = (
            [require_node(direct.graph, chosen)]
            if chosen
            else dict.fromkeys(node_names(direct.graph, hidden=args.include_hidden_nodes))
        )
        questions = {name: {"prefixes": args.param_prefixes} for name in nodes}
        answers, failed = _ask_all(direct, args, questions, "list")
        found = {name: _wanted(answer.result.names, args) for name, answer in answers.items()}
        questions = {name: {"names": names} for name, names in found.items()}
        types, failed_types = (
            _ask_all(direct, args, questions, "types") if args.param_type else ({}, set())
        )
    for name, names in found.items():
        if names and not chosen:
            print(f"{name}:")
        numbers = types[name].types if name in types else ()
        for index, parameter in enumerate(names):
            print(f"  {parameter}{f' (type: {TYPE_NAMES[numbers[index]]})' if numbers else ''}")
    return 1 if failed | failed_types else 0


def _wanted(names: list[str], args: argparse.Namespace) -> list[str]:
    return sorted(name for name in names if not args.filter or re.match(args.filter, name))


def _ask_all(
    direct: DirectNode, args: argparse.Namespace, fields: dict[str, dict[str, Any]], what: str
) -> tuple[dict[str, Any], set[str]]:
    """Ask all nodes at the same time.

    Args:
        direct: The node that asks.
        args: The command line.
        fields: The fields of the requests, by the names of the nodes that are asked.
        what: ``list`` or ``types``.

    Returns:
        The answers, and the nodes that could not be asked or did not answer, which is printed. A
        node without parameter services is neither.
    """
    service = {"list": "list_parameters", "types": "get_parameter_types"}[what]
    serving = _serving(direct, fields, service, args.timeout)
    questions, answers, failed = {}, {}, set()
    for name, request in fields.items():
        if name in serving:
            questions[name] = Question(direct, name, service, args.timeout, **request)
        else:
            _say_that_it_has_none(name)
    for step in ("send", "answer"):
        for name, question in list(questions.items()):
            try:
                answers[name] = getattr(question, step)()
            except RuntimeError as error:  # noqa: PERF203  each node may fail on its own
                if args.node_name:
                    raise
                failed.add(name)
                del questions[name]
                answers.pop(name, None)
                tell_failed_call(name, error, service)
    return answers, failed


def _serving(direct: DirectNode, nodes: Collection[str], service: str, timeout: float) -> set[str]:
    """Return the nodes that have a service.

    As ROS 2 does, it waits for those that have none: a node that has just started may be known
    before its services are.
    """
    from ros2cli.graph import services

    def found() -> set[str]:
        known = {name for name, _ in services(direct.graph, hidden=True)}
        return {name for name in nodes if f"{name}/{service}" in known}

    direct.graph.wait_for(lambda: len(found()) == len(nodes), int(timeout * 1e9))
    return found()


def _say_that_it_has_none(node_name: str) -> None:
    """ROS 2's line for a node without parameter services."""
    namespace, _, name = node_name.rpartition("/")
    shown = f"NodeName(name='{name}', namespace='{namespace or '/'}', full_name='{node_name}')"
    print(f"Wait for service timed out waiting for parameter services for node {shown}")


@verb_of_module
class ListVerb(VerbExtension):
    """List the parameters."""
