"""Zenoh subscribers without a liveliness token: bridges, storages, programs that know no ROS."""

from __future__ import annotations

import contextlib
import threading

import zenoh

import rclpy
from std_msgs.msg import String
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.zenoh.configuration import session_configuration

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
LONG = 60_000_000_000


def test_a_plain_subscriber_counts_as_a_listener():
    with (
        contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context,
        zenoh.open(session_configuration()) as peer,
    ):
        publisher = context.create_node("node").create_publisher("/chatter", STRING, QoS())
        for _ in range(2):
            assert not publisher.is_heard()
            with peer.declare_subscriber(publisher.token.data_key, lambda sample: None):
                assert context.graph.wait_for(publisher.is_heard, LONG)
                assert publisher.subscription_count() == 0
            assert context.graph.wait_for(lambda: not publisher.is_heard(), LONG)


def test_a_plain_subscriber_gets_what_a_node_publishes(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_zenoh_cpp")
    received = threading.Event()
    with (
        rclpy.Context() as context,
        zenoh.open(session_configuration()) as peer,
        peer.declare_subscriber("**", lambda sample: received.set()),
    ):
        node = rclpy.create_node("node", context=context)
        publisher = node.create_publisher(String, "chatter", 10)
        assert context.wire.graph.wait_for(publisher._wire.is_heard, LONG)
        publisher.publish(String(data="hello"))
        assert received.wait(60)


# What a subscription remembers of its publishers.


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
