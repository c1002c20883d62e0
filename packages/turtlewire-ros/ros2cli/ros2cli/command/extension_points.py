"""The class of the command ``ros2 extension_points``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["ExtensionPointsCommand"]


class ExtensionPointsCommand(BuiltinCommand, CommandExtension):
    """List the kinds of commands and verbs."""

    _module = "extension_points"
