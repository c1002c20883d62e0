"""The class of the command ``ros2 param``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["ParamCommand"]


class ParamCommand(BuiltinCommand, CommandExtension):
    """Read and set parameters of nodes."""

    _module = "param"
