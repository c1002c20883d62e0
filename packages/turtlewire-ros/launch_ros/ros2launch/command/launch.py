"""The class of the command ``ros2 launch``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["LaunchCommand"]


class LaunchCommand(BuiltinCommand, CommandExtension):
    """Run a launch file."""

    _module = "launch"
