"""``ros2 action``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2action.verb"


@command_of_module
class ActionCommand(CommandExtension):
    """List actions, and send goals."""
