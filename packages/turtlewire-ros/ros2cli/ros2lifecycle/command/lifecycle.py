"""``ros2 lifecycle``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2lifecycle.verb"


class LifecycleCommand(ModuleCommand, module=__name__):
    """Show and change the states of managed nodes."""
