"""Verbs of ``ros2 doctor``; entry points in the group ``ros2doctor.verb``."""

from ros2cli import verb
from ros2cli.plugin_system import PLUGIN_SYSTEM_VERSION

__all__ = ["PLUGIN_SYSTEM_VERSION", "VerbExtension"]


class VerbExtension(verb.VerbExtension):
    """The extension point for 'doctor' verb extensions."""
