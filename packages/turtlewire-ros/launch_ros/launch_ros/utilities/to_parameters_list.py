"""Evaluated parameters as messages."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


def to_parameters_list(
    context: LaunchContext, node_name: str, namespace: str, evaluated_parameters: Iterable[Any]
) -> list[Any]:
    """Return the parameters of one node as ``rcl_interfaces/msg/Parameter``, in the order given.

    A later value of a name replaces an earlier one.

    Args:
        context: The launch.
        node_name: The node's name.
        namespace: Its namespace.
        evaluated_parameters: As of
            :func:`launch_ros.utilities.evaluate_parameters.evaluate_parameters`. A file names
            nodes, or has parameters at its top.

    Raises:
        RCLInvalidROSArgsError: A file is malformed.
    """
    from rclpy.parameter import Parameter

    del context
    full_name = f"{namespace.rstrip('/')}/{node_name}"
    values: dict[str, Any] = {}
    for each in evaluated_parameters:
        if isinstance(each, Path):
            values.update(_of_file(each, full_name))
        elif isinstance(each, Mapping):
            values.update(each)
        else:
            values[each.name] = each.value
    return [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]


def is_node_name_matched(node_name: str, node_fqn: str) -> bool:
    """Return True if a node name of a parameter file means a node.

    Args:
        node_name: The name; ``/*`` is one token, ``/**`` any number of them.
        node_fqn: Full name of the node.
    """
    from rclpy.impl.arguments import matches_node

    return matches_node(node_name, node_fqn)


def _of_file(path: Path, full_name: str) -> dict[str, Any]:
    import yaml

    from rclpy.impl.arguments import Arguments

    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    # Without names of nodes, the file holds the parameters themselves.
    if isinstance(content, Mapping) and not _names_nodes(content):
        return _flat(content, "")
    words = ["--ros-args", "--params-file", str(path)]
    return dict(Arguments.parse_local(words).parameter_overrides(full_name))


def _names_nodes(content: Mapping[Any, Any]) -> bool:
    return any(
        key == "ros__parameters" or (isinstance(value, Mapping) and _names_nodes(value))
        for key, value in content.items()
    )


def _flat(content: Mapping[Any, Any], prefix: str) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for key, value in content.items():
        if isinstance(value, Mapping):
            flat.update(_flat(value, f"{prefix}{key}."))
        else:
            flat[f"{prefix}{key}"] = value
    return flat
