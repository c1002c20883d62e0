"""The ROS domains of this computer: finds free ones, and one in which a demo already runs."""

from __future__ import annotations

import os
import socket

from turtlewire import wire
from turtlewire.wire import environment

__all__ = ["free_domain", "other_demo_runs", "reserve"]

#: The name of the demo's simulator.
SIMULATOR = "sim"
#: How long to wait until all nodes of this computer are known [ns].
_DISCOVERY_NS = 2_000_000_000


def reserve(domain: int) -> socket.socket | None:
    """Occupy the port of a domain's first process; None if a process of the domain has it.

    As long as the socket is open, no other check takes the domain.
    """
    mark = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        mark.bind(("", 7410 + 250 * domain))
    except OSError:
        mark.close()
        return None
    return mark


def free_domain() -> tuple[int, socket.socket] | None:
    """Return a domain without processes on this computer, and the socket that reserves it.

    Below 102 the ports stay clear of those that systems hand out.
    """
    for offset in range(101):
        domain = 1 + (os.getpid() + offset) % 101
        mark = reserve(domain)
        if mark is not None:
            return domain, mark
    return None


def other_demo_runs(domain: int) -> bool:
    """Return True if another demo's simulator is in this domain, which must be the set one."""
    # Only DDS takes ports by the domain: a free one saves the discovery.
    if environment.middleware_name() == "rmw_cyclonedds_cpp" and (mark := reserve(domain)):
        mark.close()
        return False
    context = wire.open_context()
    try:
        graph = context.graph

        def is_there() -> bool:
            return any((node.name, node.namespace) == (SIMULATOR, "/") for node in graph.nodes())

        graph.wait_for(lambda: is_there() or graph.is_complete(), _DISCOVERY_NS)
        return is_there()
    finally:
        context.close()
