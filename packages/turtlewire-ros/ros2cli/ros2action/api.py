"""Actions of the graph, completions."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli import completion
from ros2cli.completion import interface_names
from ros2cli.node.direct import DirectNode

_NodesAndTypes = list[tuple[str, list[str]]]


def get_action_clients_and_servers(
    *, node: Any, action_name: str
) -> tuple[_NodesAndTypes, _NodesAndTypes]:
    """Full names of the nodes that are clients of an action, and of its servers, with the types.

    Args:
        node: The node that looks.
        action_name: Name of the action; relative to the root unless it starts with a slash.
    """
    from ros2cli.graph import action_nodes

    graph = DirectNode.around(node).graph
    full_name = action_name if action_name.startswith("/") else f"/{action_name}"
    return (
        action_nodes(graph, full_name, "subscription"),
        action_nodes(graph, full_name, "publisher"),
    )


def get_action_class(node: Any, action_name: str) -> Any:
    """Return the class of an action.

    Args:
        node: The node that looks.
        action_name: Full name of the action.

    Raises:
        RuntimeError: The action does not exist, or it has several types, or one that is not
            installed.
    """
    from ros2cli.suggestion import did_you_mean, source_meant
    from rosidl_runtime_py.utilities import get_action

    known = dict(get_action_names_and_types(node=node))
    types = known.get(action_name)
    if not types:
        meant = did_you_mean(action_name, known)
        raise RuntimeError(f"Cannot find type for '{action_name}'{meant}")
    if len(types) > 1:
        raise RuntimeError(
            f"The action '{action_name}' has more than one type: [{', '.join(types)}]"
        )
    try:
        return get_action(types[0])
    except (AttributeError, ModuleNotFoundError, ValueError):
        raise RuntimeError(
            f"The action type '{types[0]}' is invalid{source_meant(types[0])}"
        ) from None


def get_action_names_and_types(*, node: Any) -> list[tuple[str, list[str]]]:
    """Return the names and types of the actions that a node sees, sorted by name."""
    from rclpy.action import get_action_names_and_types as ask

    return ask(getattr(node, "node", node))


def get_action_names(*, node: Any) -> list[str]:
    """Return the names of the actions that a node sees, sorted."""
    return [name for name, _ in get_action_names_and_types(node=node)]


def action_name_completer(prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
    """Return the names of the actions there are now."""
    with DirectNode(parsed_args) as node:
        return get_action_names(node=node)


def action_type_completer(**kwargs: Any) -> list[str]:
    """Return the full names of all actions' types."""
    return interface_names("action")


class ActionTypeCompleter:
    """Offers the type of the action on the command line to the shell.

    Args:
        action_name_key: Attribute of the command line that is the action.
    """

    def __init__(self, *, action_name_key: str | None = None) -> None:
        self.action_name_key = action_name_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the type of the action, or all actions."""
        action = getattr(parsed_args, self.action_name_key or "", None)
        with DirectNode(parsed_args) as node:
            found = dict(get_action_names_and_types(node=node))
        return found.get(action or "") or action_type_completer()


class ActionGoalPrototypeCompleter:
    """Offers the default values of a goal of the type on the command line to the shell.

    Args:
        action_type_key: Attribute of the command line that is the type.
    """

    def __init__(self, *, action_type_key: str | None = None) -> None:
        self.action_type_key = action_type_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the default values, as YAML."""
        return completion.prototype("action", getattr(parsed_args, self.action_type_key or ""))
