"""The class of the command ``ros2 run``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["RunCommand"]


class RunCommand(BuiltinCommand, CommandExtension):
    """Run an executable of a package."""

    _module = "run"
