"""Verbs of ``ros2 action``; entry points in the group ``ros2action.verb``."""

from ros2cli import verb
from ros2cli.plugin_system import PLUGIN_SYSTEM_VERSION

__all__ = ["PLUGIN_SYSTEM_VERSION", "VerbExtension"]


class VerbExtension(verb.VerbExtension):
    """The extension point for 'action' verb extensions."""
