"""The class of the command ``ros2 service``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["ServiceCommand"]


class ServiceCommand(BuiltinCommand, CommandExtension):
    """List services, call one, watch the calls of others."""

    _module = "service"
