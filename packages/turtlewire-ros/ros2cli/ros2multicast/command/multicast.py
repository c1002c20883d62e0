"""``ros2 multicast``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2multicast.verb"


@command_of_module
class MulticastCommand(CommandExtension):
    """Find out whether this network passes multicast on."""
