"""``ros2 param``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2param.verb"


class ParamCommand(ModuleCommand, module=__name__):
    """Read and set parameters of nodes."""
