"""Frames whose publisher has left the graph: how they are found, marked and forgotten.

Names for publishers, from a graph that learns them late.
"""

import queue
import threading

import pytest

from turtlewire import Buffer, guarded, msg, wire
from turtlewire.tf.listener import QOS, STATIC_QOS, TYPE_NAME, TransformListener
from turtlewire.tf.publishers import PublisherNames
from turtlewire.wire.base import EndpointInfo, NodeInfo, TypeId
from turtlewire.wire.graph import GraphView
from turtlewire.wire.qos import QoS

from .conftest import tf_bytes

TYPE = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
LONG_S = 60.0
LONG_NS = 60_000_000_000


class NotingBuffer(Buffer):
    """A buffer that reports the frames that are removed from it."""

    def __init__(self):
        super().__init__()
        self.removed = queue.SimpleQueue()

    def remove_frame(self, child_frame):
        removed = super().remove_frame(child_frame)
        self.removed.put((child_frame, removed))
        return removed


class Robot:
    """A process that publishes transforms, as a context of its own."""

    def __init__(self, middleware, name):
        self.context = wire.open_context(middleware=middleware)
        node = self.context.create_node(name)
        self.tf = node.create_publisher("/tf", TYPE, QOS)
        self.tf_static = node.create_publisher("/tf_static", TYPE, STATIC_QOS)

    def send(self, buffer, child, publisher=None, stamp_s=1):
        """Publish a transform, and wait until the buffer has it."""
        publisher = publisher or self.tf
        self.context.graph.wait_for(lambda: publisher.subscription_count() > 0, LONG_NS)
        publisher.publish(tf_bytes("world", child, stamp_s=stamp_s))
        buffer.lookup_transform("world", child, None, timeout_ns=LONG_NS)

    def leave(self, graph):
        """Close the context, and wait until the others know it."""
        gid = self.tf.gid
        self.context.close()
        assert graph.wait_for(lambda: gid not in [end.gid for end in graph.endpoints()], LONG_NS)


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
def middleware(request):
    return request.param


@pytest.fixture
def receiver(middleware):
    context = wire.open_context(middleware=middleware)
    yield context
    context.close()


def test_a_moving_frame_is_forgotten_after_its_publisher_left(middleware, receiver):
    one, two = Robot(middleware, "one"), Robot(middleware, "two")
    buffer = NotingBuffer()
    listener = TransformListener(
        buffer, receiver.create_node("listener"), context=receiver, forget_after_ns=10_000_000
    )
    with listener:
        one.send(buffer, "moving")
        one.send(buffer, "fixed", one.tf_static)
        two.send(buffer, "other")
        assert listener.departed_frames() == []
        one.leave(receiver.graph)
        assert buffer.removed.get(timeout=LONG_S) == ("moving", True)
        assert listener.departed_frames() == []
        assert sorted(buffer.frames()) == ["fixed", "other", "world"]
        two.leave(receiver.graph)
        assert buffer.removed.get(timeout=LONG_S) == ("other", True)
        assert sorted(buffer.frames()) == ["fixed", "world"]
    assert buffer.removed.empty()


def test_frames_stay_without_the_option(middleware, receiver):
    robot, buffer = Robot(middleware, "robot"), Buffer()
    with TransformListener(buffer, receiver.create_node("listener"), context=receiver) as listener:
        robot.send(buffer, "moving")
        robot.leave(receiver.graph)
        assert listener.departed_frames() == ["moving"]
        assert "moving" in buffer


@pytest.mark.parametrize("middleware", ["local"], indirect=True)  # it delivers in no time
def test_a_frame_that_another_publisher_sends_meanwhile_stays(middleware, receiver):
    one, two = Robot(middleware, "one"), Robot(middleware, "two")
    buffer = NotingBuffer()
    listener = TransformListener(
        buffer, receiver.create_node("listener"), context=receiver, forget_after_ns=2_000_000_000
    )
    with listener:
        one.send(buffer, "taken_over")
        one.send(buffer, "left_alone")
        one.leave(receiver.graph)
        two.send(buffer, "taken_over", stamp_s=2)
        assert buffer.removed.get(timeout=LONG_S) == ("left_alone", True)
        assert listener.departed_frames() == []
        assert "taken_over" in buffer
    two.context.close()


def test_a_frame_that_the_program_sets_does_not_depart():
    context = wire.open_context(middleware="local")
    buffer = Buffer()
    buffer.set_transform("world", "own", 1, (0, 0, 0))
    node = context.create_node("listener")
    with TransformListener(buffer, node, context=context) as listener:
        assert listener.departed_frames() == []
    with TransformListener(buffer, node, context=context, topic=None) as listener:
        assert listener.departed_frames() == []
    context.close()


def test_a_negative_time_is_refused():
    with pytest.raises(ValueError, match="forget_after_ns must not be negative: -1"):
        TransformListener(Buffer(), forget_after_ns=-1)


def test_closing_does_not_wait_for_frames_that_are_due_later(middleware, receiver):
    robot, buffer = Robot(middleware, "robot"), NotingBuffer()
    listener = TransformListener(
        buffer, receiver.create_node("listener"), context=receiver, forget_after_ns=10**15
    )
    with listener:
        robot.send(buffer, "moving")
        robot.leave(receiver.graph)
    assert buffer.removed.empty()
    listener.close()


class FailingBuffer(NotingBuffer):
    """A buffer from which the removal of ``moving`` fails."""

    def remove_frame(self, child_frame):
        removed = super().remove_frame(child_frame)
        if child_frame == "moving":
            raise OSError("no thanks")
        return removed


def test_a_removal_that_fails_does_not_keep_later_frames(monkeypatch):
    reported = []
    monkeypatch.setattr(guarded, "_reported", set())
    monkeypatch.setattr(threading, "excepthook", lambda report: reported.append(report.exc_value))
    context, buffer = wire.open_context(middleware="local"), FailingBuffer()
    one, two = Robot("local", "one"), Robot("local", "two")
    with TransformListener(
        buffer, context.create_node("listener"), context=context, forget_after_ns=10_000_000
    ):
        one.send(buffer, "moving")
        two.send(buffer, "other")
        one.leave(context.graph)
        assert buffer.removed.get(timeout=LONG_S) == ("moving", True)
        two.leave(context.graph)
        assert buffer.removed.get(timeout=LONG_S) == ("other", True)
    context.close()
    assert [str(error) for error in reported] == ["no thanks"]


GID, OTHER = b"\x01" * 16, b"\x02" * 16


class Graph(GraphView):
    """Counts how often it is asked."""

    def __init__(self):
        super().__init__()
        self.known = {GID: None}
        self.asked = 0

    def nodes(self):
        return []

    def endpoints(self):
        self.asked += 1
        return [
            EndpointInfo("publisher", "/tf", "t", "", node, gid, QoS())
            for gid, node in self.known.items()
        ]


def test_the_graph_is_asked_once_for_each_publisher_and_after_its_changes():
    graph, renamed = Graph(), []
    names = PublisherNames(graph, lambda gid, name: renamed.append((gid, name)))
    assert [names[GID] for _ in range(100)] == ["01" * 16] * 100
    assert graph.asked == 1
    graph.known[OTHER] = NodeInfo("odometry", "/robot1", "/")
    assert [names[OTHER] for _ in range(100)] == ["/robot1/odometry"] * 100
    assert graph.asked == 2
    graph.known[GID] = NodeInfo("slam", "/", "/")
    graph.notify_changed()
    assert (names[GID], renamed, graph.asked) == ("/slam", [("01" * 16, "/slam")], 3)
    graph.notify_changed()
    assert graph.asked == 3


def test_many_publishers_stay_bounded():
    names = PublisherNames(Graph(), lambda gid, name: None)
    for i in range(3000):
        assert names[i.to_bytes(16, "big")] == f"{i:032x}"
    assert len(names) <= 1000


def test_a_forgotten_publisher_is_not_named_later():
    graph, renamed = Graph(), []
    names = PublisherNames(graph, lambda gid, name: renamed.append(gid))
    assert names[GID] == "01" * 16
    for i in range(1000):
        assert names[i.to_bytes(16, "big")] == f"{i:032x}"
    graph.known[GID] = NodeInfo("slam", "/", "/")
    graph.notify_changed()
    assert renamed == []
    assert names[GID] == "/slam"


def test_closed_it_listens_no_more():
    graph = Graph()
    names = PublisherNames(graph, lambda gid, name: None)
    assert names[GID] == "01" * 16
    names.close()
    graph.notify_changed()
    assert graph.asked == 1
