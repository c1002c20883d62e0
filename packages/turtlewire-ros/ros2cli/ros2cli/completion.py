"""Completions for the shell."""

from __future__ import annotations

import argparse
import os
import sys
from collections import OrderedDict
from typing import Any

_TAKES_FRAMES = {("tf2_ros", "tf2_echo"), ("tf2_ros", "tf2_monitor")}


def packages(**_: Any) -> list[str]:
    """Return the names of installed packages."""
    from turtlewire_ros.prefix import package_names

    return sorted(package_names())


def executables(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the names of the executables of the package on the command line."""
    return executables_of(parsed_args.package_name)


def executables_of(package: str) -> list[str]:
    """Return the names of the executables of a package; empty if there is no such package."""
    from turtlewire_ros.executables import executable_paths

    return [os.path.basename(path) for path in executable_paths(package) or ()]


def interface_names(kind: str = "") -> list[str]:
    """Return the full names of all interfaces, sorted; ``kind``: only of msg, srv or action."""
    from turtlewire import msg

    return sorted(
        f"{package}/{part}/{name}"
        for package, parts in msg.interfaces().items()
        for part, names in parts.items()
        if part == kind or not kind
        for name in names
    )


def interface_packages(**_: Any) -> list[str]:
    """Return the names of the packages that have interfaces."""
    from turtlewire import msg

    return sorted(msg.interfaces())


def interfaces(**_: Any) -> list[str]:
    """Return the full names of all interfaces."""
    return interface_names()


def message_types(**_: Any) -> list[str]:
    """Return the full names of all messages."""
    return interface_names("msg")


def topic_names(**_: Any) -> list[str]:
    """Return the names of the topics there are now."""
    return [name for name, _ in _ask("topics")]


def service_names(**_: Any) -> list[str]:
    """Return the names of the services there are now."""
    return [name for name, _ in _ask("services")]


def action_names(**_: Any) -> list[str]:
    """Return the names of the actions there are now."""
    return [name for name, _ in _ask("actions")]


def node_names(**_: Any) -> list[str]:
    """Return the full names of the nodes there are now."""
    names: list[str] = _ask("node_names")
    return names


def frame_names(**_: Any) -> list[str]:
    """Return the names of the frames that are published now."""
    from turtlewire.doctor.tf_traffic import frame_names

    return frame_names()


def arguments_of_executable(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the arguments of an executable: frames for tools of tf2_ros that take them."""
    executable = (parsed_args.package_name, parsed_args.executable_name)
    return frame_names() if executable in _TAKES_FRAMES else []


def files(prefix: str, **_: Any) -> list[str]:
    """Return the files and folders."""
    from argcomplete.completers import FilesCompleter

    return list(FilesCompleter()(prefix))


def folders(prefix: str, **_: Any) -> list[str]:
    """Return the folders."""
    from argcomplete.completers import DirectoriesCompleter

    return list(DirectoriesCompleter()(prefix))


def message_values(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the default values of the message type on the command line."""
    return prototype("msg", parsed_args.message_type)


def request_values(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the default values of a request of the service type on the command line."""
    return prototype("srv", parsed_args.service_type)


def goal_values(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the default values of a goal of the action type on the command line."""
    return prototype("action", parsed_args.action_type)


def prototype(kind: str, type_name: str) -> list[str]:
    """Return the default values of a message, request or goal; empty for an unknown type.

    Args:
        kind: ``msg``, ``srv`` or ``action``.
        type_name: Name of the interface.
    """
    from rosidl_runtime_py import message_to_ordereddict, utilities

    try:
        if kind == "srv":
            message = utilities.get_service(type_name).Request()
        elif kind == "action":
            message = utilities.get_action(type_name).Goal()
        else:
            message = utilities.get_message(type_name)()
    # A completion must not print an error between the user's words.
    except (AttributeError, ModuleNotFoundError, ValueError):
        return []
    return [_on_one_line(message_to_ordereddict(message))]


def _on_one_line(values: OrderedDict[str, Any]) -> str:
    import yaml

    class Dumper(yaml.SafeDumper):
        """Writes the fields in their order."""

    # On its own class, because this changes the class.
    Dumper.add_representer(OrderedDict, Dumper.represent_dict)
    text: str = yaml.dump(
        values,
        Dumper=Dumper,
        default_flow_style=True,
        sort_keys=False,
        allow_unicode=True,
        width=sys.maxsize,
    )
    return text.rstrip("\n")


def topic_types(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the type of the topic on the command line, or all messages."""
    types = dict(_ask("topics")).get(getattr(parsed_args, "topic_name", None))
    return types or interface_names("msg")


def service_types(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the type of the service on the command line, or all services."""
    types = dict(_ask("services")).get(getattr(parsed_args, "service_name", None))
    return types or interface_names("srv")


def action_types(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the type of the action on the command line, or all actions."""
    types = dict(_ask("actions")).get(getattr(parsed_args, "action_name", None))
    return types or interface_names("action")


def _ask(question: str) -> Any:
    from ros2cli import graph
    from ros2cli.discovery import discovered_graph

    with discovered_graph() as known:
        return getattr(graph, question)(known)
