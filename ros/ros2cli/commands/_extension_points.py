"""The kinds of commands and verbs, under the names that ROS 2 gives them."""

from __future__ import annotations

from importlib import import_module

from ros2cli.commands import COMMANDS
from ros2cli.installed import declared, first_line, load

__all__ = ["EXTENSION_POINTS", "extensions"]

#: Name of the extension point, the command that it belongs to, and ROS 2's description.
EXTENSION_POINTS = (
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


def extensions(point: str, command: str) -> dict[str, tuple[str, str]]:
    """Summary and module of each verb of a command, or of each command if it is empty.

    Those of other packages are loaded; one that cannot be loaded is one line on stderr.
    """
    if command and command not in COMMANDS:
        return {}
    own: dict[str, str] = (
        import_module(f"ros2cli.commands.{command}").VERBS if command else COMMANDS
    )
    package = f"ros2cli.commands.{command}" if command else "ros2cli.commands"
    found = {name: (summary, f"{package}.{name}") for name, summary in own.items()}
    for name, entry in declared(point).items():
        cls = load(entry) if name not in own else None
        if cls is not None:
            found[name] = (first_line(cls), entry.module)
    return dict(sorted(found.items()))
