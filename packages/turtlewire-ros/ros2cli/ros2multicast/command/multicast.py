"""``ros2 multicast``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2multicast.verb"


class MulticastCommand(ModuleCommand):
    """Find out whether this network passes multicast on."""
