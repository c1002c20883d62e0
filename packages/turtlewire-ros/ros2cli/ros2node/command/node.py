"""The class of the command ``ros2 node``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["NodeCommand"]


class NodeCommand(BuiltinCommand, CommandExtension):
    """List nodes, show what one of them offers."""

    _module = "node"
