"""Sequences of filters."""

from __future__ import annotations

import pytest

from geometry_msgs.msg import PointStamped
from message_filters import Cache, Chain, SimpleFilter, Subscriber
from rclpy.context import Context
from rclpy.node import Node


class Adder(SimpleFilter):
    """Adds a number to each message."""

    def __init__(self, number):
        super().__init__()
        self.number = number

    def connectInput(self, f):  # noqa: N802 -- ROS 2's name
        f.registerCallback(self.add)

    def add(self, message):
        self.signalMessage(message + self.number)


def test_messages_go_through_all_filters_and_leave_the_last_once():
    source, heard = SimpleFilter(), []
    chain = Chain(source)
    chain.registerCallback(heard.append)
    source.signalMessage("lost, because the chain has no filter yet")
    filters = [Adder("a"), Adder("b"), Adder("c")]
    for length, each in enumerate(filters, start=1):
        assert chain.addFilter(each) == length - 1
        source.signalMessage(">")
        assert heard == [">a", ">ab", ">abc"][:length]
    chain.add("<")
    assert heard[3:] == ["<abc"]
    assert [chain.getFilter(index) for index in range(-1, 4)] == [None, *filters, None]


def test_another_input_replaces_the_one_before():
    first, second, heard = SimpleFilter(), SimpleFilter(), []
    chain = Chain(first)
    chain.addFilter(Adder("!"))
    chain.registerCallback(heard.append)
    chain.connectInput(second)
    first.signalMessage("first")
    second.signalMessage("second")
    assert heard == ["second!"]


def test_a_chain_that_begins_with_a_subscriber(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    context, heard = Context(), []
    context.init(args=[])
    node = Node("chained", context=context)
    points, cache = Subscriber(node, PointStamped, "points"), Cache(cache_size=5)
    chain = Chain()
    chain.addFilter(points)
    chain.addFilter(cache)
    chain.registerCallback(heard.append)
    points.callback(message := PointStamped())
    assert heard == [message]
    assert cache.getLast() is message
    with pytest.raises(TypeError, match="Subscriber has no connectInput, so that it can only be"):
        chain.addFilter(Subscriber(node, PointStamped, "others"))
    points.callback(message)
    assert len(heard) == 2, "the chain is as it was"
    with pytest.raises(TypeError, match="a Subscriber, accepts no messages: use the chain"):
        chain.add(message)
    node.destroy_node()
    context.try_shutdown()
