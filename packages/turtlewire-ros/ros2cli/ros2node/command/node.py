"""``ros2 node``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2node.verb"


class NodeCommand(ModuleCommand, module=__name__):
    """List nodes, show what one of them offers."""
