"""The class of the command ``ros2 doctor``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["DoctorCommand", "WtfCommand"]


class DoctorCommand(BuiltinCommand, CommandExtension):
    """Look for what is wrong with the setup and the traffic."""

    _module = "doctor"


class WtfCommand(DoctorCommand):
    """The same as doctor."""
