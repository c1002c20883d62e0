"""``ros2 service``."""

from ros2cli.command import ModuleCommand
from ros2cli.listing import hidden_argument

VERB_GROUP = "ros2service.verb"


ARGUMENTS = (hidden_argument("service"),)


class ServiceCommand(ModuleCommand, module=__name__):
    """List services, call one, watch the calls of others."""
