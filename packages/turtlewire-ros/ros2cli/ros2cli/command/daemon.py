"""``ros2 daemon``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2cli.daemon.verb"


@command_of_module
class DaemonCommand(CommandExtension):
    """Start and stop the daemon, which verbs do not need."""
