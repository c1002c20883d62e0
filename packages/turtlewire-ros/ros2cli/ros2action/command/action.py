"""``ros2 action``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2action.verb"


class ActionCommand(ModuleCommand, module=__name__):
    """List actions, and send goals."""
