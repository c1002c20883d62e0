"""Versions of the interface that extensions of `Node` are written for.

An extension checks in its constructor that the interface which it was written for is the one that
is installed, as :class:`launch_ros.actions.node.NodeActionExtension` does:

    satisfies_version(self.EXTENSION_POINT_VERSION, "^0.1")

An extension whose check fails is left out with a warning, and the nodes start without it.
"""

from turtlewire.plugins import (
    PluginException,
    get_upper_bound_caret_version,
    satisfies_version,
)

__all__ = ["PluginException", "get_upper_bound_caret_version", "satisfies_version"]
