"""``ros2 interface``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2interface.verb"


@command_of_module
class InterfaceCommand(CommandExtension):
    """Show the definitions of messages, services and actions."""
