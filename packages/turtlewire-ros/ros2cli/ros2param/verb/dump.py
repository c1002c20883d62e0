"""``ros2 param dump``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.node.direct import DirectNode
from ros2param.parameters import RemoteParameters, node_arguments
from ros2param.verb import VerbExtension

PARAMETER_SEPARATOR_STRING = "."

ARGUMENTS = (*node_arguments(), JSON_ARGUMENT)


def main(args: argparse.Namespace) -> None:
    """Print all values as YAML."""
    import yaml

    from rclpy.parameter import parameter_value_to_python

    with DirectNode(args) as direct:
        remote = RemoteParameters(direct, args)
        names = remote.names()
        values = remote.values(names)
    tree: dict[str, Any] = {}
    for name, message in zip(names, values, strict=True):
        insert(tree, name.split(PARAMETER_SEPARATOR_STRING), parameter_value_to_python(message))
    file = {remote.node_name: {"ros__parameters": tree}}
    if args.json:
        print_json(file)
    else:
        print(yaml.safe_dump(file, default_flow_style=False))


def insert(tree: dict[str, Any], path: list[str], value: Any) -> None:
    """Put a value into nested dictionaries, one for each part of its name."""
    for part in path[:-1]:
        tree = tree.setdefault(part, {})
    tree[path[-1]] = value


class DumpVerb(VerbExtension, module=__name__):
    """Show all parameters of a node as a parameter file."""

    def insert_dict(self, dictionary: dict[str, Any], key: str, value: Any) -> None:
        """Put a value into nested dictionaries, one for each part of a dotted name."""
        insert(dictionary, key.split(PARAMETER_SEPARATOR_STRING), value)
