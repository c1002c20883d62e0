"""Predicates over the nodes of a launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from launch_ros.utilities.namespace_utils import make_namespace_absolute


class NamedNode(Protocol):
    """The attributes of a ``Node`` or ``LifecycleNode`` that matchers read."""

    @property
    def node_name(self) -> str:
        """Full name of the node."""


def matches_node_name(node_name: str) -> Callable[[NamedNode], bool]:
    """Matches the node with this full name."""
    absolute = make_namespace_absolute(node_name)
    return lambda node: node.node_name == absolute
