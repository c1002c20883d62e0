"""The class of the command ``ros2 multicast``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["MulticastCommand"]


class MulticastCommand(BuiltinCommand, CommandExtension):
    """Find out whether this network passes multicast on."""

    _module = "multicast"
