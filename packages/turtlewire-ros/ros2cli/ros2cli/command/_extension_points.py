"""The kinds of commands and verbs, under ROS 2's names, and other packages'."""

from __future__ import annotations

from importlib import import_module
from typing import NamedTuple

from ros2cli.commands import COMMANDS
from ros2cli.installed import EXTENSION_POINT_GROUP_NAME, declared, first_line, load

__all__ = ["ExtensionPoint", "extension_points", "extensions"]

#: Name of the extension point, the command that it belongs to, and ROS 2's description.
_OWN = (
    ("ros2action.verb", "action", "The extension point for 'action' verb extensions"),
    ("ros2bag.verb", "bag", "The extension point for 'bag' verb extensions"),
    ("ros2cli.command", "", "The extension point for 'command' extensions"),
    ("ros2cli.daemon.verb", "daemon", "The extension point for 'daemon' verb extensions"),
    ("ros2component.verb", "component", "The extension point for 'node' verb extensions"),
    ("ros2doctor.verb", "doctor", "The extension point for 'doctor' verb extensions"),
    ("ros2interface.verb", "interface", "Extension point for 'interface' verb extensions"),
    ("ros2lifecycle.verb", "lifecycle", "The extension point for 'lifecycle' verb extensions"),
    ("ros2multicast.verb", "multicast", "The extension point for 'msg' verb extensions"),
    ("ros2node.verb", "node", "The extension point for 'node' verb extensions"),
    ("ros2param.verb", "param", "The extension point for 'param' verb extensions"),
    ("ros2pkg.verb", "pkg", "The extension point for 'pkg' verb extensions"),
    ("ros2service.verb", "service", "The extension point for 'service' verb extensions"),
    ("ros2topic.verb", "topic", "The extension point for 'topic' verb extensions"),
)


class ExtensionPoint(NamedTuple):
    """A kind of commands or verbs."""

    name: str
    description: str
    #: Where the extensions of this distribution are, or the class of another package's point.
    module: str
    #: Summaries by name of the extensions of this distribution.
    own: dict[str, str]


def extension_points() -> list[ExtensionPoint]:
    """Return the extension points of this distribution and of other packages.

    The latter are loaded; one that cannot be loaded is one line on stderr.
    """
    found = []
    for name, command, description in _OWN:
        if not command:
            found.append(ExtensionPoint(name, description, "ros2cli.commands", COMMANDS))
        elif command in COMMANDS:
            module = f"ros2cli.commands.{command}"
            found.append(ExtensionPoint(name, description, module, import_module(module).VERBS))
    names = {point.name for point in found}
    for name, entry in sorted(declared(EXTENSION_POINT_GROUP_NAME).items()):
        cls = load(entry) if name not in names else None
        if cls is not None:
            found.append(ExtensionPoint(name, first_line(cls), entry.module, {}))
    return found


def extensions(point: ExtensionPoint) -> dict[str, tuple[str, str]]:
    """Summary and module of each extension of a point, by name.

    Other packages' are loaded; one that cannot be loaded is one line on stderr.
    """
    own = point.own
    found = {name: (summary, f"{point.module}.{name}") for name, summary in own.items()}
    for name, entry in declared(point.name).items():
        cls = load(entry) if name not in own else None
        if cls is not None:
            found[name] = (first_line(cls), entry.module)
    return dict(sorted(found.items()))
