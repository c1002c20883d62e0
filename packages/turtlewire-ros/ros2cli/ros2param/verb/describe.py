"""The class of ``ros2 param describe``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2param.verb import VerbExtension

__all__ = ["DescribeVerb"]


class DescribeVerb(BuiltinVerb, VerbExtension):
    """Show what a parameter is for, and its limits."""

    _module = "param.describe"
