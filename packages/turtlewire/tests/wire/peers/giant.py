"""Publishes messages of many megabytes until it is killed; says so before each of them."""

from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

SIZE = 50_000_000

context = open_context()
publisher = context.create_node("giant").create_publisher(
    "/giant", TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64), QoS(depth=1)
)
assert context.graph.wait_for(lambda: publisher.subscription_count() > 0, 60_000_000_000)
message = b"\x00\x01\x00\x00" + bytes(SIZE)
while True:
    print("sending", flush=True)
    publisher.publish(message)
