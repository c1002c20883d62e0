"""Verbs of ``ros2 lifecycle``; entry points in the group ``ros2lifecycle.verb``."""

from ros2cli import verb
from ros2cli.plugin_system import PLUGIN_SYSTEM_VERSION

__all__ = ["PLUGIN_SYSTEM_VERSION", "VerbExtension"]


class VerbExtension(verb.VerbExtension):
    """The extension point for 'lifecycle' verb extensions."""
