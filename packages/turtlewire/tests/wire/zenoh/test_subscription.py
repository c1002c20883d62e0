"""What a subscription remembers of its publishers."""

from __future__ import annotations

import contextlib

from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

KIND = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
LONG_NS = 60_000_000_000


def test_publishers_that_come_and_go_leave_nothing():
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context:
        node, graph = context.create_node("node"), context.graph
        subscription = node.create_subscription("/name", KIND, QoS())
        wait_set = context.create_wait_set()
        wait_set.attach(subscription)
        for _ in range(2):
            publisher = node.create_publisher("/name", KIND, QoS())
            assert graph.wait_for(lambda: subscription.publisher_count() == 1, LONG_NS)
            publisher.publish(b"\0\1\0\0text")
            assert wait_set.wait(LONG_NS) == [subscription]
            assert len(subscription.take()) == 1
            assert list(subscription._last_numbers) == [publisher.gid]
            publisher.close()
            assert graph.wait_for(lambda: not subscription._last_numbers, LONG_NS)
