"""A node that looks at the graph itself, under ROS 2's name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli import direct_node
from ros2cli.node import NODE_NAME_PREFIX

if TYPE_CHECKING:
    import argparse
    from types import TracebackType

__all__ = ["DEFAULT_TIMEOUT", "NODE_NAME_PREFIX", "DirectNode", "add_arguments"]

#: Seconds for which ROS 2 looks; here that is the time of ``--spin-time``, if it is given.
DEFAULT_TIMEOUT = 0.5


class DirectNode(direct_node.DirectNode):
    """A hidden node that knows the graph; a context manager.

    It has all attributes of the `rclpy.node.Node` in its attribute ``node``.

    Args:
        args: The command line, with the arguments of `add_arguments`; None for the defaults.
        node_name: Name of the node; by default one made of the process id.
    """

    def __init__(self, args: argparse.Namespace | None, *, node_name: str | None = None) -> None:
        import argparse

        super().__init__(args or argparse.Namespace(), name=node_name)

    def __enter__(self) -> DirectNode:  # noqa: PYI034  Self is not in Python 3.10
        """Wait for discovery."""
        super().__enter__()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Leave the domain."""
        super().__exit__(exc_type, exc_value, traceback)

    def __getattr__(self, name: str) -> Any:
        if name == "node":  # the constructor has failed
            raise AttributeError(name)
        return getattr(self.node, name)

    def get_action_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Names and types of all actions."""
        from rclpy.action import get_action_names_and_types

        return get_action_names_and_types(self.node)

    def get_action_client_names_and_types_by_node(
        self, remote_node_name: str, remote_node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Names and types of the actions that a node may start."""
        from rclpy.action import get_action_client_names_and_types_by_node as ask

        return ask(self.node, remote_node_name, remote_node_namespace)

    def get_action_server_names_and_types_by_node(
        self, remote_node_name: str, remote_node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Names and types of the actions that a node offers."""
        from rclpy.action import get_action_server_names_and_types_by_node as ask

        return ask(self.node, remote_node_name, remote_node_namespace)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--spin-time`` and ``--use-sim-time``."""
    from ros2cli import arguments
    from ros2cli.discovery import SPIN_ARGUMENTS

    arguments.add_arguments(parser, SPIN_ARGUMENTS)
