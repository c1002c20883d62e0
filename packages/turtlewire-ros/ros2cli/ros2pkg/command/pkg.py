"""``ros2 pkg``."""

from ros2cli.command import ModuleCommand

VERB_GROUP = "ros2pkg.verb"


class PkgCommand(ModuleCommand, module=__name__):
    """List and create packages."""
