"""Finds interface definitions by name and keeps the parsed ones.

A definition is looked for in the packages registered by generated modules, in the definitions that
come with turtlewire, below ``share/<package>`` of every prefix in ``AMENT_PREFIX_PATH`` and of the
environment that turtlewire is installed in, and last by importing the package, which lets a
generated one register itself.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator

from turtlewire.errors import InterfaceError
from turtlewire.msg.bundled import (
    bundled_definitions,
    bundled_file,
    bundled_interfaces,
    bundled_packages,
    is_listed,
)
from turtlewire.msg.definition import (
    ActionDefinition,
    MessageDefinition,
    ServiceDefinition,
    split_name,
)
from turtlewire.msg.parser import parse_action, parse_message, parse_service
from turtlewire.package_sources import source_hint
from turtlewire.path_arguments import near_path, path_text

KINDS = ("msg", "srv", "action")

Definition = MessageDefinition | ServiceDefinition | ActionDefinition

#: Folder of a prefix with a file for each package that has interfaces.
_INDEX = os.path.join("share", "ament_index", "resource_index", "rosidl_interfaces")

_registered: dict[str, str] = {}
_loaded: dict[str, Definition] = {}
#: Where an interface was not found, until when that counts, and the hint: to look for it and for
#: similar names takes 35 ms, and a bag may ask for each of its messages.
_not_found: dict[str, tuple[tuple[str, ...], float, str]] = {}
_NOT_FOUND_S = 5.0


def add_package(package: str, directory: str) -> None:
    """Register the folder with the definitions of a package.

    Args:
        package: Name of the package.
        directory: The folder that contains its ``msg``, ``srv`` and ``action`` folders.

    Raises:
        InterfaceError: ``package`` cannot be the name of a package, or the folder has none of
            these.
        NotADirectoryError: ``directory`` is not a folder.
    """
    if not (isinstance(package, str) and package.isascii() and package.isidentifier()):
        raise InterfaceError(f"{package!r} is not the name of a package").with_hint(
            "Names look like my_msgs; the folder comes second: add_package('my_msgs', 'folder')."
        )
    directory = path_text(directory, "directory", "folder of the package")
    if not os.path.isdir(directory):
        advice = "" if os.path.exists(directory) else near_path(directory)
        raise NotADirectoryError(f"{directory} is not a folder{advice}")
    if not any(os.path.isdir(os.path.join(directory, kind)) for kind in KINDS):
        raise InterfaceError(f"{directory} contains none of the folders msg, srv and action")
    _registered[package] = directory
    _not_found.clear()


def load_message(full_name: str) -> MessageDefinition:
    """Definition of a message (``"pkg/msg/X"``) or part of a service (``"pkg/srv/X_Request"``).

    Raises:
        InterfaceError: The message does not exist, or its file cannot be read.
    """
    definition = load_interface(full_name)
    if not isinstance(definition, MessageDefinition):
        error = InterfaceError(f"'{full_name}' is not a message")
        kind = full_name.split("/")[1]
        raise error.with_hint(f"msg.get_{'service' if kind == 'srv' else 'action'} returns it.")
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
    """Path of the file that defines ``"pkg/msg/X"``; for ours, that of the whole package.

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
            _with_package(full_name)
            or _with_slashes(full_name)
            or "Names look like geometry_msgs/msg/Twist, turtlesim/srv/Spawn or "
            "turtlesim/action/RotateAbsolute."
        )
    package, kind, name = parts
    places = (os.environ.get("AMENT_PREFIX_PATH", ""), *sys.path)
    failed = _not_found.get(full_name)
    if failed and failed[0] == places and time.monotonic() < failed[1]:
        raise InterfaceError(f"unknown interface '{full_name}'").with_hint(failed[2])
    if package not in _registered and (bundled := bundled_file(full_name)):
        return bundled
    for directory in _directories(package):
        path = os.path.join(directory, kind, f"{name}.{kind}")
        if os.path.isfile(path):
            return path
    hint = _nearest(full_name)
    _not_found[full_name] = places, time.monotonic() + _NOT_FOUND_S, hint
    raise InterfaceError(f"unknown interface '{full_name}'").with_hint(hint)


def interface_text(full_name: str) -> str:
    """Text of the definition of ``"pkg/msg/X"``; raises as `interface_path` does."""
    path = interface_path(full_name)
    if path.endswith(".txt"):
        return bundled_definitions(path)[full_name]
    with open(path, encoding="utf-8") as file:
        return file.read()


def interfaces() -> dict[str, dict[str, list[str]]]:
    """Return all interfaces that can be found without importing anything.

    Of those that come with turtlewire, these are the ones of the process's distribution.

    Returns:
        ``{package: {"msg": [...], "srv": [...], "action": [...]}}``, sorted.
    """
    directories = _installed()
    for parent in reversed(_parents()):
        directories.update(_packages_in(parent))
    ours = bundled_packages()
    listed = {
        package: interfaces_in(directory)
        for package, directory in directories.items()
        if package not in ours
    }
    for package in ours:
        listed[package] = {
            kind: [name for name in names if is_listed(f"{package}/{kind}/{name}")]
            for kind, names in bundled_interfaces(package).items()
        }
    listed |= {package: interfaces_in(directory) for package, directory in _registered.items()}
    return {package: listed[package] for package in sorted(listed) if any(listed[package].values())}


def _packages_in(parent: str) -> dict[str, str]:
    if not os.path.isdir(parent):
        return {}
    return {entry.name: entry.path for entry in os.scandir(parent) if entry.is_dir()}


def _with_package(name: str) -> str:
    """Return a hint at the interfaces with this name in all packages; empty without any."""
    found = [
        f"{package}/{kind}/{name}"
        for package, kinds in interfaces().items()
        for kind, names in kinds.items()
        if name in names
    ]
    return f"Did you mean {' or '.join(found)}?" if found else ""


def class_advice(name: str) -> str:
    """Return how to get the messages of a name or package; empty for others."""
    if not name[:1].isalpha():
        return ""
    known = interfaces()
    if name in known and known[name]["msg"]:
        return f"; write msg.get_message('{name}/msg/{known[name]['msg'][0]}')"
    packages = sorted(known, key=lambda package: (package.startswith("example"), package))
    found = [f"{package}/msg/{name}" for package in packages if name in known[package]["msg"]]
    return f"; write msg.get_message('{found[0]}')" if found else ""


def _with_slashes(name: str) -> str:
    """Return a hint for a name with dots, blanks or too many slashes; empty for others."""
    meant = name.strip().replace(".", "/").strip("/")
    parts = meant.split("/")
    if len(parts) != 3 or parts[1] not in KINDS or meant == name:
        return ""
    return f"Write '{meant}'."


def load_interface(full_name: str) -> Definition:
    """Definition of any interface or part of one; raises as `load_message` does."""
    definition = _loaded.get(full_name)
    if definition is None:
        package, *rest = full_name.split("/")
        kind, name = rest[:2] if len(rest) > 1 else ("", "")
        is_whole = not (package and name)
        whole = full_name if is_whole else f"{package}/{kind}/{name.partition('_')[0]}"
        define(whole, interface_text(whole))
        definition = _loaded.get(full_name)
        if definition is None:
            raise InterfaceError(f"unknown interface '{full_name}'")
    return definition


def define(full_name: str, text: str, *, strict: bool = True) -> None:
    """Make an interface known by its text, as if it had been read from a file.

    Args:
        full_name: ``"pkg/msg/X"``, ``"pkg/srv/X"`` or ``"pkg/action/X"``.
        text: What the file would hold.
        strict: See `parse_message`; services and actions are always parsed strictly.

    Raises:
        InterfaceError: The text cannot be parsed; says which line and why.
    """
    _, kind, _ = split_name(full_name)
    if kind == "msg":
        _loaded[full_name] = parse_message(full_name, text, strict=strict)
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
    return [os.path.join(prefix, "share") for prefix in prefixes if prefix]


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

    if hint := source_hint(full_name):
        return hint
    package = full_name.partition("/")[0]
    if not difflib.get_close_matches(package, interfaces(), n=1, cutoff=0.85):
        same = _with_package(full_name.rpartition("/")[2])
        own = f"msg.add_package('{package}', folder) adds your own definitions."
        return f"{same or '`ros2 interface list` shows all interfaces.'} {own}"
    known = [
        f"{package}/{kind}/{name}"
        for package, kinds in interfaces().items()
        for kind, names in kinds.items()
        for name in names
    ]
    near = difflib.get_close_matches(full_name, known, n=3)
    return (
        f"Did you mean {' or '.join(near)}?"
        if near
        else "`ros2 interface list` shows all interfaces."
    )
