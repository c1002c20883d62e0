"""``ros2 daemon``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2cli.daemon.verb"


class DaemonCommand(ModuleCommand, module=__name__):
    """Start and stop the daemon, which verbs do not need."""
