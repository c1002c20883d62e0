"""``ros2 wtf``, which is ``ros2 doctor``."""

from __future__ import annotations

from ros2cli.commands.doctor import add_arguments, main

__all__ = ["add_arguments", "main"]
