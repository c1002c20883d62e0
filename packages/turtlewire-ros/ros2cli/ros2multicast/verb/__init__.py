"""Verbs of ``ros2 multicast``; entry points in the group ``ros2multicast.verb``."""

from __future__ import annotations

import argparse

from ros2cli import verb
from ros2cli.arguments import add_arguments, positive_int
from ros2cli.plugin_system import PLUGIN_SYSTEM_VERSION
from ros2multicast.api import DEFAULT_GROUP, DEFAULT_PORT, GROUP_ARGUMENTS

__all__ = [
    "DEFAULT_GROUP",
    "DEFAULT_PORT",
    "PLUGIN_SYSTEM_VERSION",
    "VerbExtension",
    "add_group_argument",
    "add_port_argument",
    "positive_int",
]


class VerbExtension(verb.VerbExtension):
    """The extension point for 'msg' verb extensions."""


def add_group_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--group``."""
    add_arguments(parser, GROUP_ARGUMENTS[:1])


def add_port_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--port``."""
    add_arguments(parser, GROUP_ARGUMENTS[1:])
