"""One of many processes: says when its node is there and when it sees all nodes and their endpoints (argument: how many)."""

from __future__ import annotations

import sys
import time

from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

count = int(sys.argv[1])
context = open_context()
node = context.create_node("member", f"/of{count}")
type_id = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
node.create_publisher("/chatter", type_id, QoS())
node.create_subscription("/chatter", type_id, QoS())
graph = context.graph


def sees_everybody() -> bool:
    if len(graph.nodes()) < count:
        return False
    owned = [endpoint for endpoint in graph.endpoints() if endpoint.topic == "/chatter" and endpoint.node is not None]
    return len(owned) == 2 * count


print("up", time.time(), flush=True)
assert graph.wait_for(sees_everybody, 60_000_000_000), (len(graph.nodes()), len(graph.endpoints()))
print("sees", time.time(), flush=True)
sys.stdin.read()
context.close()
