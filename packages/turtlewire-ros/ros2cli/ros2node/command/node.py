"""``ros2 node``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2node.verb"


@command_of_module
class NodeCommand(CommandExtension):
    """List nodes, show what one of them offers."""
