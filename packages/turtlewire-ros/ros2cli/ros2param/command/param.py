"""``ros2 param``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2param.verb"


@command_of_module
class ParamCommand(CommandExtension):
    """Read and set parameters of nodes."""
