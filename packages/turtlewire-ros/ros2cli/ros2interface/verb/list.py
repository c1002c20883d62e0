"""The class of ``ros2 interface list``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.interface.list import print_kind
from ros2interface.verb import VerbExtension

__all__ = ["ListVerb", "print_actions", "print_messages", "print_services"]


class ListVerb(BuiltinVerb, VerbExtension):
    """List all interfaces."""

    _module = "interface.list"


def print_messages() -> None:
    """Print the names of all messages."""
    print_kind("msg")


def print_services() -> None:
    """Print the names of all services."""
    print_kind("srv")


def print_actions() -> None:
    """Print the names of all actions."""
    print_kind("action")
