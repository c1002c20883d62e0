"""``ros2 service``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension
from ros2cli.listing import hidden_argument

VERB_GROUP = "ros2service.verb"


ARGUMENTS = (hidden_argument("service"),)


@command_of_module
class ServiceCommand(CommandExtension):
    """List services, call one, watch the calls of others."""
