"""Sends messages that no correct peer sends.

Each line of its input is a topic (one without a leading slash is a DDS topic), a type, a type hash
and a message in hex, until an empty line.
"""

from __future__ import annotations

import sys

from turtlewire.wire import open_context
from turtlewire.wire.base import Publisher, TypeId
from turtlewire.wire.qos import QoS

LONG = 60_000_000_000


def has_subscription(publisher: Publisher) -> bool:
    return publisher.subscription_count() > 0


context = open_context()
node = context.create_node("hostile")
publishers: dict[tuple[str, str], Publisher] = {}
for line in sys.stdin:
    words = line.split()
    if not words:
        break
    topic, type_name, type_hash, data = words
    if (topic, type_hash) not in publishers:
        qos = QoS(depth=100, avoid_ros_namespace_conventions=not topic.startswith("/"))
        publisher = publishers[topic, type_hash] = node.create_publisher(
            topic, TypeId(type_name, type_hash), qos
        )
        assert context.graph.wait_for(lambda: has_subscription(publisher), LONG)  # noqa: B023
    publishers[topic, type_hash].publish(bytes.fromhex(data))
print("sent", flush=True)
sys.stdin.read()
context.close()
