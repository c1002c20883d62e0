"""Predicates over the managed nodes of a launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch_ros.utilities.namespace_utils import make_namespace_absolute

if TYPE_CHECKING:
    from launch_ros.events.matchers.matches_node_name import NamedNode


def matches_node_name(node_name: str) -> Callable[[NamedNode], bool]:
    """Matches the managed node with this full name."""
    absolute = make_namespace_absolute(node_name)
    return lambda node: node.node_name == absolute
