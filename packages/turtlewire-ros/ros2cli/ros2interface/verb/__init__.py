"""Verbs of ``ros2 interface``; entry points in the group ``ros2interface.verb``."""

from ros2cli import verb
from ros2cli.plugin_system import PLUGIN_SYSTEM_VERSION

__all__ = ["PLUGIN_SYSTEM_VERSION", "VerbExtension"]


class VerbExtension(verb.VerbExtension):
    """Extension point for 'interface' verb extensions."""
