"""What the shell is offered to complete a word."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

__all__ = [
    "action_names",
    "action_types",
    "arguments_of_executable",
    "executables",
    "frame_names",
    "interface_packages",
    "interfaces",
    "managed_node_names",
    "node_names",
    "packages",
    "parameter_names",
    "service_names",
    "service_types",
    "topic_names",
    "topic_types",
]


_TAKES_FRAMES = {("tf2_ros", "tf2_echo"), ("tf2_ros", "tf2_monitor")}


def packages(**_: Any) -> list[str]:
    """Names of installed packages."""
    from turtlewire_ros.prefix import package_names

    return sorted(package_names())


def executables(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Names of the executables of the package on the command line."""
    from turtlewire_ros.executables import executable_paths

    return [os.path.basename(path) for path in executable_paths(parsed_args.package_name) or ()]


def interface_packages(**_: Any) -> list[str]:
    """Names of the packages that have interfaces."""
    from turtlewire import msg

    return sorted(msg.interface_names())


def interfaces(**_: Any) -> list[str]:
    """Full names of all interfaces."""
    from turtlewire import msg

    return sorted(
        f"{package}/{kind}/{name}"
        for package, kinds in msg.interface_names().items()
        for kind, names in kinds.items()
        for name in names
    )


def topic_names(**_: Any) -> list[str]:
    """Names of the topics there are now."""
    return [name for name, _ in _ask("topics")]


def service_names(**_: Any) -> list[str]:
    """Names of the services there are now."""
    return [name for name, _ in _ask("services")]


def action_names(**_: Any) -> list[str]:
    """Names of the actions there are now."""
    return [name for name, _ in _ask("actions")]


def node_names(**_: Any) -> list[str]:
    """Full names of the nodes there are now."""
    names: list[str] = _ask("node_names")
    return names


def frame_names(**_: Any) -> list[str]:
    """Names of the frames that are published now."""
    from turtlewire.cli.tf_traffic import frame_names

    return frame_names()


def arguments_of_executable(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """What may follow the name of an executable; known for those of tf2_ros that take frames."""
    executable = (parsed_args.package_name, parsed_args.executable_name)
    return frame_names() if executable in _TAKES_FRAMES else []


def topic_types(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Type of the topic on the command line, or all messages."""
    types = dict(_ask("topics")).get(getattr(parsed_args, "topic_name", None))
    return types or [name for name in interfaces() if "/msg/" in name]


def service_types(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Type of the service on the command line, or all services."""
    types = dict(_ask("services")).get(getattr(parsed_args, "service_name", None))
    return types or [name for name in interfaces() if "/srv/" in name]


def action_types(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Type of the action on the command line, or all actions."""
    types = dict(_ask("actions")).get(getattr(parsed_args, "action_name", None))
    return types or [name for name in interfaces() if "/action/" in name]


def _ask(question: str) -> Any:
    from ros2cli import graph
    from ros2cli.discovery import GraphNode

    with GraphNode() as known:
        return getattr(graph, question)(known)


def parameter_names(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Names of the parameters of the node on the command line."""
    from ros2cli.direct_node import DirectNode
    from ros2cli.parameters import RemoteParameters

    with DirectNode(parsed_args) as direct:
        return RemoteParameters(direct, parsed_args).names([])


def managed_node_names(**_: Any) -> list[str]:
    """Full names of the managed nodes there are now."""
    from ros2cli.discovery import GraphNode
    from ros2cli.managed_nodes import managed_nodes

    with GraphNode() as known:
        return managed_nodes(known)
