"""Waits for the graph, for commands that look at it once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.doctor.setup_findings import looks_for_others

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

__all__ = ["wait_for_graph"]

_DISCOVERY_LIMIT_NS = 2_000_000_000
_OTHER_HOSTS_NS = 500_000_000  # as long as ROS 2's own tools wait for other hosts


def wait_for_graph(graph: Graph) -> None:
    """Wait until all nodes of this host are known, and for a moment for nodes of other hosts.

    It returns after at most 2.5 seconds, even if something on this host keeps silent.
    """
    graph.hurry()
    if looks_for_others():
        graph.wait_for(lambda: False, _OTHER_HOSTS_NS)
    graph.wait_for(graph.is_complete, _DISCOVERY_LIMIT_NS)
