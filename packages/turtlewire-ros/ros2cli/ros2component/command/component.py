"""The class of the command ``ros2 component``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["ComponentCommand"]


class ComponentCommand(BuiltinCommand, CommandExtension):
    """Containers of nodes: list them, load and unload nodes."""

    _module = "component"
