"""``ros2 pkg``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2pkg.verb"


@command_of_module
class PkgCommand(CommandExtension):
    """List and create packages."""
