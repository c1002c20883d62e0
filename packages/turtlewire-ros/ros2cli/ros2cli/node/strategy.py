"""The node that commands ask about the graph; ROS 2 chooses between its daemon and a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.node import direct

if TYPE_CHECKING:
    import argparse
    from types import TracebackType

    from ros2cli.node.daemon import DaemonNode

__all__ = ["NodeStrategy", "add_arguments"]


class NodeStrategy:
    """Has all attributes of a `DirectNode`, which is made when it is first needed.

    There is no daemon here, so that this is what ROS 2 does with ``--no-daemon``.

    Args:
        args: The command line, with the arguments of `add_arguments`; None for the defaults.
    """

    def __init__(self, args: argparse.Namespace | None) -> None:
        self._args = args
        self._direct_node: direct.DirectNode | None = None
        self._is_entered = False

    @property
    def daemon_node(self) -> DaemonNode | None:
        """None, because no daemon runs."""
        return None

    @property
    def direct_node(self) -> direct.DirectNode:
        """The node; it has waited for discovery if it is used in a ``with`` statement."""
        if self._direct_node is None:
            self._direct_node = direct.DirectNode(self._args)
            if self._is_entered:
                self._direct_node.__enter__()
        return self._direct_node

    def __enter__(self) -> NodeStrategy:  # noqa: PYI034  Self is not in Python 3.10
        self._is_entered = True
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._is_entered = False
        node, self._direct_node = self._direct_node, None
        if node is not None:
            node.__exit__(exc_type, exc_value, traceback)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.direct_node, name)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--spin-time``, ``--use-sim-time`` and ``--no-daemon``."""
    from ros2cli import arguments
    from ros2cli.discovery import STRATEGY_ARGUMENTS

    arguments.add_arguments(parser, STRATEGY_ARGUMENTS)
