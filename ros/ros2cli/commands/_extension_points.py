"""The kinds of commands and verbs, under the names that ROS 2 gives them."""

from __future__ import annotations

from importlib import import_module

from ros2cli.commands import COMMANDS

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


def extensions(command: str) -> dict[str, str]:
    """Names and summaries of the verbs of a command, or of all commands if it is empty."""
    if not command:
        return COMMANDS
    if command not in COMMANDS:
        return {}
    verbs: dict[str, str] = import_module(f"ros2cli.commands.{command}").VERBS
    return verbs
