"""The wire as a source: its publishers, and the history that a page can go back to."""

from __future__ import annotations

import contextlib
import queue

import pytest

from turtlewire import Buffer, msg
from turtlewire.errors import WireError
from turtlewire.tf.tf_topics import TfTopics
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS
from turtlewire_view import LiveSource
from turtlewire_view.live import LiveTimeline

LATCHED = Durability.TRANSIENT_LOCAL
SECOND = 10**9
#: Stamps from here on are system time, earlier ones are of a simulation.
WALL_NS = 10**18


class History:
    """A source with ten seconds of history."""

    history_ns = 10 * SECOND

    def __init__(self, *stamps_ns):
        self.buffer = Buffer(None)
        self.add(*stamps_ns)

    def add(self, *stamps_ns):
        for stamp_ns in stamps_ns:
            self.buffer.set_transform("map", "base", stamp_ns, (0.0, 0.0, 0.0))


@pytest.fixture
def source(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with contextlib.closing(LiveSource()) as source:
        yield source


def test_the_publisher_used_longest_ago_ends_for_the_seventeenth(source):
    def published():
        ends = source._context.graph.endpoints()
        return {end.topic for end in ends if end.kind == "publisher" and end.topic != "/rosout"}

    topics = [f"/topic{number}" for number in range(16)]
    for topic in [*topics, "/topic0"]:
        assert source.publish(topic, "std_msgs/msg/Empty", b"\0\1\0\0\0") == 0
    assert published() == {*topics}
    source.publish("/another", "std_msgs/msg/Empty", b"\0\1\0\0\0")
    assert published() == {*topics, "/another"} - {"/topic1"}


def test_a_subscription_that_cannot_be_replaced_is_named_and_tried_again(source, monkeypatch):
    def fail(*_):
        raise WireError("out of resources")

    heard, changed = queue.SimpleQueue(), queue.SimpleQueue()
    source.subscribe("/chatter", "std_msgs/msg/Empty", heard.put)
    source.on_change(lambda: changed.put(source.problem))
    empty = TypeId("std_msgs/msg/Empty", msg.type_hash("std_msgs/msg/Empty"))
    with monkeypatch.context() as full:
        full.setattr(source._node, "create_subscription", fail)
        publisher = source._node.create_publisher("/chatter", empty, QoS(durability=LATCHED))
        while changed.get(timeout=60) != "/chatter may not be shown: out of resources":
            pass
    publisher.publish(b"\0\1\0\0\0")
    assert heard.get(timeout=60) == b"\0\1\0\0\0"  # by the former subscription
    source._node.create_publisher("/other", empty, QoS())
    while changed.get(timeout=60):
        pass
    assert heard.get(timeout=60) == b"\0\1\0\0\0"  # again, because it was latched


def test_the_transforms_of_a_robot_in_a_namespace(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    topics = TfTopics("/robot1/tf", "/robot1/tf_static")
    with contextlib.closing(LiveSource(topics=topics)) as source:
        graph = source._context.graph
        heard = {end.topic for end in graph.endpoints() if end.kind == "subscription"}
    assert heard == {"/robot1/tf", "/robot1/tf_static"}


def test_a_page_goes_back_as_far_as_the_history():
    timeline = LiveTimeline(History(0, 5 * SECOND, 100 * SECOND))
    assert (timeline.state().oldest, timeline.state().newest) == (90.0, 100.0)
    for asked, shown in ((89, 90), (90, 90), (91, 91), (100, 100), (101, 100)):
        timeline.seek(asked * SECOND)
        assert timeline.stamp_ns() == shown * SECOND
        assert timeline.state().now == shown
    young = LiveTimeline(History(95 * SECOND, 100 * SECOND))
    assert young.state().oldest == 95.0


def test_a_paused_timeline_stays_until_it_is_played():
    source = History(SECOND, 2 * SECOND)
    timeline = LiveTimeline(source)
    assert (timeline.stamp_ns(), timeline.state().live) == (None, True)
    for _ in range(2):  # a second pause keeps the first one's picture
        timeline.pause()
        source.add(3 * SECOND)
        assert (timeline.stamp_ns(), timeline.state().newest) == (2 * SECOND, 2.0)
        assert not timeline.state().live
    timeline.seek(3 * SECOND)
    assert timeline.stamp_ns() == 2 * SECOND
    timeline.play()
    assert (timeline.stamp_ns(), timeline.state().now) == (None, 3.0)
    timeline.pause()
    assert timeline.stamp_ns() == 3 * SECOND


@pytest.mark.parametrize(("newest_ns", "is_simulated"), [(WALL_NS - 1, True), (WALL_NS, False)])
def test_stamps_of_a_simulation_are_told_by_their_size(source, newest_ns, is_simulated):
    source.buffer.set_transform("map", "base", newest_ns, (0.0, 0.0, 0.0))
    assert source.new_timeline().state().simulated is is_simulated
    assert (source.now_ns() == newest_ns) is is_simulated


def test_without_moving_frames_there_is_no_history(source):
    source.buffer.set_static_transform("map", "base", (0.0, 0.0, 0.0))
    timeline = source.new_timeline()
    timeline.pause()
    assert (timeline.stamp_ns(), timeline.state().oldest, timeline.state().newest) == (None, 0, 0)
    assert source.now_ns() > WALL_NS
