"""Joins the domain until its nodes are discovered."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.helpers import check_discovery_configuration
from turtlewire.wake_up import WakeUp
from turtlewire.wire.environment import Range, discovery

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

# Other hosts have this much time to answer; participants of this host are counted. Measured on
# two cores: the last of 50 participants answers 70 ms after the first question.
_ANSWER_S = 0.15
# Fast DDS repeats lost data every three seconds.
_PATIENCE_S = 4.0

# With their hashes, so that no definition has to be read.
_NODE_TOPICS = (
    (
        "/rosout",
        "rcl_interfaces/msg/Log",
        "RIHS01_e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac",
        10_000_000_000,
    ),
    (
        "/parameter_events",
        "rcl_interfaces/msg/ParameterEvent",
        "RIHS01_043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204",
        0,
    ),
)


SPIN_ARGUMENTS = (
    argument(
        "--spin-time",
        type=float,
        default=None,
        help="Seconds to wait for discovery (default: until it is complete)",
    ),
    argument("-s", "--use-sim-time", action="store_true", help="Use the time of /clock"),
)


STRATEGY_ARGUMENTS = (
    *SPIN_ARGUMENTS,
    argument(
        "--no-daemon", action="store_true", help="Accepted for compatibility: no daemon is asked"
    ),
)


def wait_until_discovered(graph: Graph, spin_time: float | None = None) -> None:
    """Wait until the graph is known.

    That is when all participants of this host, and all that they announced, are known, and other
    hosts that are in range had the time to answer. When something that is announced does not
    arrive, the wait ends after four seconds without news.

    Args:
        graph: The graph.
        spin_time: Wait exactly this number of seconds instead.
    """
    only_this_host = (
        sys.platform == "linux"
        and discovery().range in (Range.LOCALHOST, Range.OFF)
        and not discovery().asked_peers
    )
    answer_time = 0.0 if only_this_host else _ANSWER_S
    check_discovery_configuration()
    changed = WakeUp()
    stop_listening = graph.add_listener(changed.set)
    # After the listener is added, so that no answer is missed.
    graph.hurry()
    started = last_change = time.monotonic()
    try:
        while True:
            now = time.monotonic()
            if spin_time is not None:
                rest = started + spin_time - now
            elif graph.is_complete():
                rest = started + answer_time - now
            else:
                rest = last_change + _PATIENCE_S - now
            if rest <= 0:
                return
            if changed.wait(rest):
                last_change = time.monotonic()
    finally:
        stop_listening()


@contextmanager
def discovered_graph(spin_time: float | None = None) -> Iterator[Graph]:
    """Join the domain with a hidden node, wait for discovery, and yield the graph.

    The node starts faster than one of rclpy, since it sends and receives nothing.

    Args:
        spin_time: Seconds to wait for discovery; None waits until all is known.
    """
    from turtlewire.wire import open_context
    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import Durability, QoS

    context = open_context()
    try:
        node = context.create_node(hidden_node_name())
        # Every node has these; without them an empty domain's lists would differ from ROS 2.
        for topic, type_name, type_hash, lifespan in _NODE_TOPICS:
            durability = Durability.TRANSIENT_LOCAL if lifespan else Durability.VOLATILE
            node.create_publisher(
                topic,
                TypeId(type_name, type_hash),
                QoS(depth=1000, durability=durability, lifespan_ns=lifespan),
            )
        wait_until_discovered(context.graph, spin_time)
        yield context.graph
    finally:
        context.close()


def hidden_node_name(suffix: str | None = None) -> str:
    """Return the name of this process's node, which by default ends in the process id."""
    return f"_ros2cli{suffix or f'_{os.getpid()}'}"
