"""``ros2 component``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2component.verb"


class ComponentCommand(ModuleCommand, module=__name__):
    """Containers of nodes: list them, load and unload nodes."""
