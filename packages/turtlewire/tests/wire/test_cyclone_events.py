"""The events that only a real wire has."""

from __future__ import annotations

import threading

from tests.needs import needs_cyclone_dds

from turtlewire import guarded
from turtlewire.wire.base import Context, EventKind, TypeId
from turtlewire.wire.qos import Liveliness, QoS

pytestmark = needs_cyclone_dds

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
MESSAGE = b"\x00\x01\x00\x00" + bytes(8)
LONG = 60_000_000_000
MILLISECOND = 1_000_000


def connected(contexts: list[Context], qos: QoS):
    publisher = contexts[0].create_node("talker").create_publisher("/chatter", STRING, qos)
    subscription = contexts[1].create_node("listener").create_subscription("/chatter", STRING, qos)
    assert contexts[0].graph.wait_for(
        lambda: publisher.subscription_count() == 1 and subscription.publisher_count() == 1, LONG
    )
    return publisher, subscription


def wait_for(context: Context, event, expected):
    wait_set = context.create_wait_set()
    wait_set.attach(event)
    while True:
        assert wait_set.wait(LONG) == [event]
        status = event.take()
        if expected(status):
            return status


def test_a_match_during_the_callbacks_of_another_is_told_too(contexts: list[Context]):
    node = contexts[0].create_node("talker")
    publisher = node.create_publisher("/chatter", STRING, QoS())
    counts, seen_all = [], threading.Event()

    def on_matched():
        counts.append(publisher.subscription_count())
        if counts == [1]:
            node.create_subscription("/chatter", STRING, QoS())
        if counts[-1] == 2:
            seen_all.set()

    publisher.on_matched.append(on_matched)
    node.create_subscription("/chatter", STRING, QoS())
    assert seen_all.wait(60)
    assert counts == [1, 2]


def test_a_call_that_raises_at_a_match_keeps_nothing_from_the_others(
    contexts: list[Context], monkeypatch
):
    reported, matched = [], threading.Event()
    monkeypatch.setattr(guarded, "_reported", set())
    monkeypatch.setattr(threading, "excepthook", lambda report: reported.append(report.exc_type))
    publisher = contexts[0].create_node("talker").create_publisher("/chatter", STRING, QoS())
    publisher.on_matched += [[].pop, matched.set]
    event = publisher.create_event(EventKind.MATCHED)
    contexts[1].create_node("listener").create_subscription("/chatter", STRING, QoS())
    assert matched.wait(60)
    assert wait_for(contexts[0], event, lambda status: status.current_count == 1)
    assert reported == [IndexError]


def test_a_missed_deadline_is_reported_on_both_sides(contexts: list[Context]):
    publisher, subscription = connected(contexts, QoS(deadline_ns=20 * MILLISECOND))
    offered = publisher.create_event(EventKind.DEADLINE_MISSED)
    requested = subscription.create_event(EventKind.DEADLINE_MISSED)
    publisher.publish(MESSAGE)
    assert (
        wait_for(contexts[0], offered, lambda status: status.total_count >= 2).total_count_change
        >= 1
    )
    assert (
        wait_for(contexts[1], requested, lambda status: status.total_count >= 2).total_count_change
        >= 1
    )


def test_lost_liveliness_is_reported_on_both_sides(contexts: list[Context]):
    qos = QoS(liveliness=Liveliness.MANUAL_BY_TOPIC, liveliness_lease_ns=50 * MILLISECOND)
    publisher, subscription = connected(contexts, qos)
    lost = publisher.create_event(EventKind.LIVELINESS_LOST)
    changed = subscription.create_event(EventKind.LIVELINESS_CHANGED)
    publisher.assert_liveliness()
    assert wait_for(contexts[0], lost, lambda status: status.total_count >= 1)
    assert wait_for(contexts[1], changed, lambda status: status.total_count == 1).current_count == 0
    publisher.publish(MESSAGE)
    assert wait_for(contexts[1], changed, lambda status: status.current_count == 1).total_count == 0


def test_an_incompatible_deadline_names_its_policy(contexts: list[Context]):
    publisher = contexts[0].create_node("talker").create_publisher("/chatter", STRING, QoS())
    contexts[1].create_node("listener").create_subscription(
        "/chatter", STRING, QoS(deadline_ns=MILLISECOND)
    )
    event = publisher.create_event(EventKind.INCOMPATIBLE_QOS)
    assert wait_for(contexts[0], event, lambda _: True).last_policy_kind == 4


def test_message_lost_can_be_watched(contexts: list[Context]):
    """Cyclone 11 has the counter but never raises it; nodes that install the callback must work."""
    subscription = (
        contexts[0].create_node("listener").create_subscription("/chatter", STRING, QoS())
    )
    assert subscription.create_event(EventKind.MESSAGE_LOST).take() is None
