"""The class of the command ``ros2 bag``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["BagCommand"]


class BagCommand(BuiltinCommand, CommandExtension):
    """Look at recorded messages."""

    _module = "bag"
