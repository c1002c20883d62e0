"""The class of the command ``ros2 daemon``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["DaemonCommand"]


class DaemonCommand(BuiltinCommand, CommandExtension):
    """Status of the daemon, which does not exist and is not needed."""

    _module = "daemon"
