"""The in-process middleware compares an endpoint only with endpoints of the same topic."""

import pytest

from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.local import bus
from turtlewire.wire.qos import QoS

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
TOPICS = 200


@pytest.fixture
def context():
    opened = open_context(77, middleware="local")
    yield opened
    opened.close()


def test_endpoints_of_other_topics_are_not_looked_at(context, monkeypatch):
    compared = []
    meet = bus._meet
    monkeypatch.setattr(
        bus,
        "_meet",
        lambda publisher, subscription: (
            compared.append(publisher.topic),
            meet(publisher, subscription),
        ),
    )
    node = context.create_node("one")
    publishers = [
        node.create_publisher(f"/topic{number}", STRING, QoS()) for number in range(TOPICS)
    ]
    subscriptions = [
        node.create_subscription(f"/topic{number}", STRING, QoS()) for number in range(TOPICS)
    ]
    assert compared == [f"/topic{number}" for number in range(TOPICS)]
    assert {publisher.subscription_count() for publisher in publishers} == {1}
    assert {subscription.publisher_count() for subscription in subscriptions} == {1}


@pytest.mark.parametrize("last", [0, 1])
def test_topics_without_endpoints_are_forgotten(context, last):
    node = context.create_node("one")
    before = len(context.bus._topics)
    ends = [
        node.create_publisher("/chatter", STRING, QoS()),
        node.create_subscription("/chatter", STRING, QoS()),
    ]
    ends[1 - last].close()
    assert [end.kind for end in context.graph.endpoints()] == [("publisher", "subscription")[last]]
    ends[last].close()
    assert len(context.bus._topics) == before
    assert context.graph.endpoints() == []
