"""``ros2 topic``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension
from ros2cli.listing import hidden_argument

VERB_GROUP = "ros2topic.verb"


ARGUMENTS = (hidden_argument("topic"),)


@command_of_module
class TopicCommand(CommandExtension):
    """List topics, listen to one, publish to one."""
