"""Verbs of ``ros2 daemon``; entry points in the group ``ros2cli.daemon.verb``."""

from ros2cli import verb
from ros2cli.plugin_system import PLUGIN_SYSTEM_VERSION, satisfies_version

__all__ = ["PLUGIN_SYSTEM_VERSION", "VerbExtension", "satisfies_version"]


class VerbExtension(verb.VerbExtension):
    """The extension point for 'daemon' verb extensions."""
