"""``ros2 multicast``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2multicast.verb"


class MulticastCommand(ModuleCommand, module=__name__):
    """Find out whether this network passes multicast on."""
