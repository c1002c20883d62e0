"""``ros2 interface``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2interface.verb"


class InterfaceCommand(ModuleCommand, module=__name__):
    """Show the definitions of messages, services and actions."""
