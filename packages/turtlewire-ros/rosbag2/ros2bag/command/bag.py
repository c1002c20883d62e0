"""``ros2 bag``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2bag.verb"


class BagCommand(ModuleCommand, module=__name__):
    """Look at recorded messages."""
