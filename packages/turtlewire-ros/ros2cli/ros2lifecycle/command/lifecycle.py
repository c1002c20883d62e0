"""``ros2 lifecycle``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2lifecycle.verb"


@command_of_module
class LifecycleCommand(CommandExtension):
    """Show and change the states of managed nodes."""
