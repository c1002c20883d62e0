"""``ros2 topic``."""

from ros2cli.command import ModuleCommand
from ros2cli.listing import hidden_argument

VERB_GROUP = "ros2topic.verb"


ARGUMENTS = (hidden_argument("topic"),)


class TopicCommand(ModuleCommand, module=__name__):
    """List topics, listen to one, publish to one."""
