"""The class of the command ``ros2 test``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["TestCommand"]


class TestCommand(BuiltinCommand, CommandExtension):
    """Run a launch test in a domain of its own."""

    _module = "test"
