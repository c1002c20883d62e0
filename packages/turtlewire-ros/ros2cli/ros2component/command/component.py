"""``ros2 component``."""

from ros2cli.builtin import command_of_module
from ros2cli.command import CommandExtension

VERB_GROUP = "ros2component.verb"


@command_of_module
class ComponentCommand(CommandExtension):
    """Containers of nodes: list them, load and unload nodes."""
