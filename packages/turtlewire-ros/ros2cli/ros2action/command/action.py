"""The class of the command ``ros2 action``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["ActionCommand"]


class ActionCommand(BuiltinCommand, CommandExtension):
    """Goals that take time: list them, send one."""

    _module = "action"
