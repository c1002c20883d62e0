"""The node that extensions ask about the graph: the daemon if it runs, or a node of their own."""

from __future__ import annotations

import argparse
from types import TracebackType
from typing import Any

from ros2cli.node.daemon import DaemonNode, is_daemon_running
from ros2cli.node.direct import DirectNode


class NodeStrategy:
    """Asks the daemon what it knows; otherwise it has all attributes of a `DirectNode`.

    The daemon is asked if it runs and ``--no-daemon`` is not given; ROS 2 would also start it.

    Args:
        args: The command line, with the arguments of `add_arguments`; None for the defaults.
        node_name: Name of the node; by default one made of the process id.
    """

    def __init__(self, args: argparse.Namespace | None, *, node_name: str | None = None) -> None:
        self._args = args
        self._node_name = node_name
        self._is_entered = False
        self._direct_node: DirectNode | None = None
        self._daemon_node: DaemonNode | None = None
        self._offered: list[str] = []
        if not getattr(args, "no_daemon", False) and is_daemon_running(args):
            self._daemon_node = DaemonNode(args)
            self._offered = self._daemon_node.methods
        else:
            self._direct_node = DirectNode(args, node_name=node_name)

    @property
    def daemon_node(self) -> DaemonNode | None:
        """The connection to the daemon, if it is asked."""
        return self._daemon_node

    @property
    def direct_node(self) -> DirectNode:
        """The node; beside the daemon it is made at the first use."""
        if self._direct_node is None:
            self._direct_node = DirectNode(self._args, node_name=self._node_name)
            if self._is_entered:
                self._direct_node.__enter__()
        return self._direct_node

    def __enter__(self) -> NodeStrategy:  # noqa: PYI034  Self is not in Python 3.10
        """Wait for discovery, unless the daemon has done so."""
        self._is_entered = True
        for node in (self._daemon_node, self._direct_node):
            if node is not None:
                node.__enter__()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Leave the domain."""
        self._is_entered = False
        for node in (self._direct_node, self._daemon_node):
            if node is not None:
                node.__exit__(exc_type, exc_value, traceback)

    def __getattr__(self, name: str) -> Any:
        if name in ("_offered", "_direct_node"):  # the constructor has failed
            raise AttributeError(name)
        return getattr(self._daemon_node if name in self._offered else self.direct_node, name)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--spin-time``, ``--use-sim-time`` and ``--no-daemon``."""
    from ros2cli import arguments
    from ros2cli.discovery import STRATEGY_ARGUMENTS

    arguments.add_arguments(parser, STRATEGY_ARGUMENTS)
