"""The class of the command ``ros2 topic``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinCommand
from ros2cli.command import CommandExtension

__all__ = ["TopicCommand"]


class TopicCommand(BuiltinCommand, CommandExtension):
    """List topics, listen to one, publish to one."""

    _module = "topic"
