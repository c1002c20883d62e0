"""The class of the command ``ros2 extensions``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["ExtensionsCommand"]


class ExtensionsCommand(BuiltinCommand, CommandExtension):
    """List all commands and verbs."""

    _module = "extensions"
