"""The node that extensions ask about the graph; ROS 2 chooses between its daemon and a node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.node import direct

if TYPE_CHECKING:
    import argparse

    from ros2cli.node.daemon import DaemonNode

__all__ = ["NodeStrategy", "add_arguments"]


class NodeStrategy(direct.DirectNode):
    """A `DirectNode`: there is no daemon, so that this is what ROS 2 does with ``--no-daemon``.

    Args:
        args: The command line, with the arguments of `add_arguments`; None for the defaults.
        node_name: Name of the node; by default one made of the process id.
    """

    def __init__(self, args: argparse.Namespace | None, *, node_name: str | None = None) -> None:
        super().__init__(args, node_name=node_name)

    @property
    def daemon_node(self) -> DaemonNode | None:
        """None, because no daemon runs."""
        return None

    @property
    def direct_node(self) -> direct.DirectNode:
        """The node itself."""
        return self


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--spin-time``, ``--use-sim-time`` and ``--no-daemon``."""
    from ros2cli import arguments
    from ros2cli.discovery import STRATEGY_ARGUMENTS

    arguments.add_arguments(parser, STRATEGY_ARGUMENTS)
