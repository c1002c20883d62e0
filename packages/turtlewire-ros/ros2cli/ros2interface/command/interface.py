"""The class of the command ``ros2 interface``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["InterfaceCommand"]


class InterfaceCommand(BuiltinCommand, CommandExtension):
    """Show the definitions of messages, services and actions."""

    _module = "interface"
