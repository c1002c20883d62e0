"""Run one of many processes.

Says when its node is there, and when it sees so many nodes and their endpoints (arguments: how
many, in turn).
"""

from __future__ import annotations

import os
import sys
import time

from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

LONG = 300_000_000_000

context = open_context()
node = context.create_node(f"member_{os.getpid()}", "/crowd")
type_id = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
node.create_publisher("/chatter", type_id, QoS())
node.create_subscription("/chatter", type_id, QoS())
graph = context.graph


def sees(count: int) -> bool:
    if len(graph.nodes()) < count:
        return False
    owned = [
        endpoint
        for endpoint in graph.endpoints()
        if endpoint.topic == "/chatter" and endpoint.node is not None
    ]
    return len(owned) >= 2 * count


print("up", time.time(), flush=True)
for count in map(int, sys.argv[1:]):
    if not graph.wait_for(lambda: sees(count), LONG):  # noqa: B023
        sys.exit(f"sees {len(graph.nodes())} of {count} nodes, {len(graph.endpoints())} endpoints")
    print("sees", time.time(), flush=True)
sys.stdin.read()
context.close()
