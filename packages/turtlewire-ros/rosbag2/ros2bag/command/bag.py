"""``ros2 bag``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2bag.verb"


@command_of_module
class BagCommand(CommandExtension):
    """Look at recorded messages."""
