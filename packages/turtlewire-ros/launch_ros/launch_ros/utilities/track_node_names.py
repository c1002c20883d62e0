"""Counts the nodes of one name within a launch."""

from __future__ import annotations

import collections
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_KEY = "unique_ros_node_names"


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return the number of nodes of this full name that the launch has started."""
    count: int = context.get_locals_as_dict().get(_KEY, {}).get(node_name, 0)
    return count


def add_node_name(context: LaunchContext, node_name: str) -> int:
    """Count one more; returns how many there are now."""
    counts = context.get_locals_as_dict().get(_KEY)
    if counts is None:
        counts = collections.Counter()
        context.extend_globals({_KEY: counts})
    counts[node_name] += 1
    number: int = counts[node_name]
    return number
