"""The class of the command ``ros2 lifecycle``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["LifecycleCommand"]


class LifecycleCommand(BuiltinCommand, CommandExtension):
    """Show and change the states of managed nodes."""

    _module = "lifecycle"
