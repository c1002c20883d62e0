"""The class of the command ``ros2 daemon``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["DaemonCommand"]


class DaemonCommand(BuiltinCommand, CommandExtension):
    """Status of the daemon (there is none, and none is needed)."""

    _module = "daemon"
