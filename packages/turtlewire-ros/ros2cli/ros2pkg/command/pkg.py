"""The class of the command ``ros2 pkg``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["PkgCommand"]


class PkgCommand(BuiltinCommand, CommandExtension):
    """List and create packages."""

    _module = "pkg"
