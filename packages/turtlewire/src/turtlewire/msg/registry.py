"""Finds interface definitions by name and keeps the parsed ones.

A definition is looked for in the packages registered by generated modules, in the definitions that
come with turtlewire, below ``share/<package>`` of every prefix in ``AMENT_PREFIX_PATH`` and of the
environment that turtlewire is installed in, and last by importing the package, which lets a
generated one register itself.
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire.msg.definition import (
    ActionDefinition,
    MessageDefinition,
    ServiceDefinition,
    split_name,
)
from turtlewire.msg.parser import parse_action, parse_message, parse_service

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = [
    "KINDS",
    "Definition",
    "define",
    "interface_names",
    "interface_path",
    "interfaces_in",
    "load_action",
    "load_interface",
    "load_message",
    "load_service",
    "register_package",
]

KINDS = ("msg", "srv", "action")

_BUNDLED = os.path.join(os.path.dirname(__file__), "interfaces")

Definition = MessageDefinition | ServiceDefinition | ActionDefinition

#: Folder of a prefix with a file for each package that has interfaces.
_INDEX = os.path.join("share", "ament_index", "resource_index", "rosidl_interfaces")

_registered: dict[str, str] = {}
_loaded: dict[str, Definition] = {}


def register_package(package: str, directory: str) -> None:
    """Register the folder with the definitions of a package.

    Args:
        package: Name of the package.
        directory: The folder that contains its ``msg``, ``srv`` and ``action`` folders.
    """
    _registered[package] = directory


def load_message(full_name: str) -> MessageDefinition:
    """Definition of a message (``"pkg/msg/X"``) or part of a service (``"pkg/srv/X_Request"``).

    Raises:
        InterfaceError: The message does not exist, or its file cannot be read.
    """
    definition = load_interface(full_name)
    if not isinstance(definition, MessageDefinition):
        raise InterfaceError(f"'{full_name}' is not a message")
    return definition


def load_service(full_name: str) -> ServiceDefinition:
    """Definition of a service, ``"pkg/srv/X"``; raises as `load_message` does."""
    definition = load_interface(full_name)
    if not isinstance(definition, ServiceDefinition):
        raise InterfaceError(f"'{full_name}' is not a service")
    return definition


def load_action(full_name: str) -> ActionDefinition:
    """Definition of an action, ``"pkg/action/X"``; raises as `load_message` does."""
    definition = load_interface(full_name)
    if not isinstance(definition, ActionDefinition):
        raise InterfaceError(f"'{full_name}' is not an action")
    return definition


def interface_path(full_name: str) -> str:
    """Path of the file that defines ``"pkg/msg/X"``.

    Raises:
        InterfaceError: The interface does not exist.
    """
    parts = full_name.split("/")
    if (
        len(parts) != 3
        or parts[1] not in KINDS
        or not all(part.isascii() and part.isidentifier() for part in parts)
    ):
        raise InterfaceError(f"'{full_name}' is not the name of an interface").with_hint(
            "Names look like geometry_msgs/msg/Twist, turtlesim/srv/Spawn or "
            "turtlesim/action/RotateAbsolute."
        )
    package, kind, name = parts
    for directory in _directories(package):
        path = os.path.join(directory, kind, f"{name}.{kind}")
        if os.path.isfile(path):
            return path
    raise InterfaceError(f"unknown interface '{full_name}'").with_hint(_nearest(full_name))


def interface_names() -> dict[str, dict[str, list[str]]]:
    """Return all interfaces that can be found without importing anything.

    ``{package: {"msg": [...], "srv": [...], "action": [...]}}``, sorted.
    """
    directories = _installed()
    for parent in reversed(_parents()):
        if os.path.isdir(parent):
            directories.update(
                (entry.name, entry.path) for entry in os.scandir(parent) if entry.is_dir()
            )
    directories.update(_registered)
    packages = {package: interfaces_in(directories[package]) for package in sorted(directories)}
    return {package: kinds for package, kinds in packages.items() if any(kinds.values())}


def load_interface(full_name: str) -> Definition:
    """Definition of any interface or part of one; raises as `load_message` does."""
    definition = _loaded.get(full_name)
    if definition is None:
        package, kind, name = [*full_name.split("/"), "", ""][:3]
        _parse_file(f"{package}/{kind}/{name.partition('_')[0]}")
        definition = _loaded.get(full_name)
        if definition is None:
            raise InterfaceError(f"unknown interface '{full_name}'")
    return definition


def _parse_file(full_name: str) -> None:
    with open(interface_path(full_name), encoding="utf-8") as file:
        define(full_name, file.read())


def define(full_name: str, text: str) -> None:
    """Make an interface known by its text, as if it had been read from a file.

    Args:
        full_name: ``"pkg/msg/X"``, ``"pkg/srv/X"`` or ``"pkg/action/X"``.
        text: What the file would hold.

    Raises:
        InterfaceError: The text cannot be parsed; says which line and why.
    """
    _, kind, _ = split_name(full_name)
    if kind == "msg":
        _loaded[full_name] = parse_message(full_name, text)
    elif kind == "srv":
        _store_service(parse_service(full_name, text))
    else:
        action = parse_action(full_name, text)
        _loaded[full_name] = action
        _store_service(action.send_goal)
        _store_service(action.get_result)
        _loaded.update((message.full_name, message) for message in action.messages())


def _store_service(service: ServiceDefinition) -> None:
    _loaded[service.full_name] = service
    _loaded.update((message.full_name, message) for message in service.messages())


def _parents() -> list[str]:
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [_BUNDLED, *(os.path.join(prefix, "share") for prefix in prefixes if prefix)]


def _installed() -> dict[str, str]:
    """Return the packages with interfaces that pip put into the environment of turtlewire, by name.

    Such an environment needs no sourcing.
    """
    folders, folder = [sys.prefix], os.path.dirname(os.path.abspath(__file__))
    while folder != os.path.dirname(folder):
        folder = os.path.dirname(folder)
        folders.append(folder)
    for prefix in folders:
        index = os.path.join(prefix, _INDEX)
        if os.path.isdir(index):
            return {name: os.path.join(prefix, "share", name) for name in os.listdir(index)}
    return {}


def _directories(package: str) -> Iterator[str]:
    if package in _registered:
        yield _registered[package]
        return
    for parent in _parents():
        yield os.path.join(parent, package)
    if package in (installed := _installed()):
        yield installed[package]
    if _import_registers(package):
        yield _registered[package]


def _import_registers(package: str) -> bool:
    import importlib

    try:
        importlib.import_module(package)
    except ImportError:
        return False
    return package in _registered


def interfaces_in(directory: str) -> dict[str, list[str]]:
    """Names of the interfaces defined in a folder, by kind, sorted."""
    found: dict[str, list[str]] = {}
    for kind in KINDS:
        folder = os.path.join(directory, kind)
        files = os.listdir(folder) if os.path.isdir(folder) else []
        found[kind] = sorted(file.rpartition(".")[0] for file in files if file.endswith(f".{kind}"))
    return found


def _nearest(full_name: str) -> str:
    import difflib

    known = [
        f"{package}/{kind}/{name}"
        for package, kinds in interface_names().items()
        for kind, names in kinds.items()
        for name in names
    ]
    near = difflib.get_close_matches(full_name, known, n=3)
    return (
        f"Did you mean {' or '.join(near)}?"
        if near
        else "`ros2 interface list` shows what there is."
    )
