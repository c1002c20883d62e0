"""The raw-bytes listener over both middlewares.

Data arrive without anybody spinning, and no message object is ever made.
"""

import gc
import math
import os
import queue
import threading
import weakref

import pytest

from turtlewire import Buffer, errors, msg, wire
from turtlewire.errors import InvalidTransformError, WireError
from turtlewire.tf import faults, refusal_warnings
from turtlewire.tf.links import links
from turtlewire.tf.listener import QOS, STATIC_QOS, TYPE_NAME, TransformListener
from turtlewire.tf.restarts import RestartWatch
from turtlewire.wire import report
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

from .conftest import tf_bytes

TYPE = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
LONG_NS = 60_000_000_000


class Domain:
    """A publishing and a listening context."""

    def __init__(self, middleware):
        self.sender, self.receiver = (wire.open_context(middleware=middleware) for _ in range(2))
        self.talker = self.sender.create_node("talker")
        self.node = self.receiver.create_node("listener")
        self.tf = self.talker.create_publisher("/tf", TYPE, QOS)
        self.tf_static = self.talker.create_publisher(
            "/tf_static", TYPE, STATIC_QOS._replace(depth=1)
        )

    def wait_for_subscriptions(self, publisher, count=1):
        assert self.sender.graph.wait_for(
            lambda: publisher.subscription_count() == count, LONG_NS
        ), publisher.subscription_count()

    def subscriptions(self, topic="/tf"):
        return [
            end
            for end in self.receiver.graph.endpoints()
            if (end.kind, end.topic) == ("subscription", topic)
        ]


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def domain(request):
    domain = Domain(request.param)
    yield domain
    domain.sender.close()
    domain.receiver.close()


def test_transforms_arrive_while_nobody_spins(domain):
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(tf_bytes("world", "robot", x=3.0))
        assert buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS).translation == (
            3.0,
            0.0,
            0.0,
        )


def test_no_message_object_is_made(domain, monkeypatch):
    data = tf_bytes("world", "robot")

    def forbidden(*_arguments, **_keywords):
        raise AssertionError("the listener decoded a message")

    monkeypatch.setattr(msg, "deserialize", forbidden)
    for name in (
        TYPE_NAME,
        "geometry_msgs/msg/TransformStamped",
        "geometry_msgs/msg/Transform",
        "std_msgs/msg/Header",
    ):
        monkeypatch.setattr(msg.get_message(name), "__init__", forbidden)
        monkeypatch.setattr(msg.get_message(name), "_from_cdr", forbidden)
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(data)
        assert (
            buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS).target_frame
            == "world"
        )


def test_it_arrives_on_the_reader_thread_of_the_wire(domain):
    buffer, arrived, threads = Buffer(), threading.Event(), []
    buffer.on_change(lambda: (threads.append(threading.current_thread()), arrived.set()))
    with TransformListener(buffer, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(tf_bytes("world", "robot"))
        assert arrived.wait(60)
    assert threads[0] is not threading.main_thread()


def test_static_transforms_reach_those_who_come_later(domain):
    domain.tf_static.publish(tf_bytes("world", "wall", x=1.0))
    first, second = Buffer(), Buffer()
    with TransformListener(first, domain.node, context=domain.receiver):
        assert (
            first.lookup_transform("world", "wall", None, timeout_ns=LONG_NS).translation[0] == 1.0
        )
        with TransformListener(
            second, domain.node, context=domain.receiver
        ):  # joins a subscription that has received it already
            assert (
                second.lookup_transform("world", "wall", None, timeout_ns=LONG_NS).translation[0]
                == 1.0
            )


def test_buffers_of_a_context_share_the_subscription_and_nothing_else(domain):
    buffers = [Buffer() for _ in range(5)]
    listeners = [
        TransformListener(buffer, domain.node, context=domain.receiver) for buffer in buffers
    ]
    domain.wait_for_subscriptions(domain.tf)
    counts = [0, 0]

    def seen():
        counts[:] = (len(domain.subscriptions(topic)) for topic in ("/tf", "/tf_static"))
        return all(counts)

    assert domain.receiver.graph.wait_for(seen, LONG_NS)
    assert counts == [1, 1]
    domain.tf.publish(tf_bytes("world", "robot"))
    for buffer in buffers:
        buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
    buffers[0].clear()
    assert buffers[1].lookup_transform("world", "robot").stamp_ns == 1_000_000_000
    with pytest.raises(errors.TransformException):
        buffers[0].lookup_transform("world", "robot", 5)
    for listener in listeners:
        listener.close()
    domain.wait_for_subscriptions(domain.tf, 0)


def test_other_topics_and_other_qualities_are_not_shared(domain):
    buffers = [Buffer() for _ in range(3)]
    other = domain.talker.create_publisher("/robot1/tf", TYPE, QOS)
    with (
        TransformListener(buffers[0], domain.node, context=domain.receiver),
        TransformListener(
            buffers[1], domain.node, context=domain.receiver, topic="/robot1/tf", static_topic=None
        ),
        TransformListener(
            buffers[2], domain.node, context=domain.receiver, qos=QoS(depth=1), static_topic=None
        ),
    ):
        domain.wait_for_subscriptions(domain.tf, 2)
        domain.wait_for_subscriptions(other, 1)
        other.publish(tf_bytes("world", "robot1"))
        buffers[1].lookup_transform("world", "robot1", None, timeout_ns=LONG_NS)
        domain.tf.publish(tf_bytes("world", "robot"))
        for buffer in (buffers[0], buffers[2]):
            buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
        assert "robot1" not in buffers[0]
        assert "robot" not in buffers[1]


def test_static_only(domain):
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver, topic=None):
        domain.wait_for_subscriptions(domain.tf_static)
        assert domain.tf.subscription_count() == 0
        domain.tf_static.publish(tf_bytes("world", "wall"))
        buffer.lookup_transform("world", "wall", None, timeout_ns=LONG_NS)


def test_the_subscription_moves_on_when_its_first_owner_leaves(domain):
    other_node = domain.receiver.create_node("other")
    first, second = Buffer(), Buffer()
    leaving = TransformListener(first, domain.node, context=domain.receiver)
    with TransformListener(second, other_node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        leaving.close()
        domain.node.close()
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(tf_bytes("world", "robot"))
        second.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
        assert "robot" not in first


def test_the_subscription_moves_on_past_a_closed_node(domain):
    nodes = [domain.receiver.create_node(name) for name in ("first", "second", "third")]
    buffers = [Buffer() for _ in nodes]
    first, second, third = (
        TransformListener(buffer, node, context=domain.receiver)
        for buffer, node in zip(buffers, nodes, strict=True)
    )
    nodes[1].close()
    first.close()
    nodes[0].close()
    assert [end.node.name for end in domain.subscriptions("/tf_static")] == ["third"]
    domain.tf_static.publish(tf_bytes("world", "robot"))
    buffers[2].lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
    second.close()
    third.close()


def test_a_listener_that_fails_leaves_the_topic_to_others(domain):
    closed = domain.receiver.create_node("closed")
    closed.close()
    with pytest.raises(WireError, match="the node is closed"):
        TransformListener(Buffer(), closed, context=domain.receiver)
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(tf_bytes("world", "robot"))
        buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
    assert domain.subscriptions() == []


def test_closing_stops_the_flow_and_keeps_the_data(domain):
    buffer, still_open = Buffer(), Buffer()
    listener = TransformListener(buffer, domain.node, context=domain.receiver)
    with TransformListener(still_open, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(tf_bytes("world", "robot", stamp_s=1))
        buffer.lookup_transform("world", "robot", 1_000_000_000, timeout_ns=LONG_NS)
        listener.close()
        listener.close()
        domain.tf.publish(tf_bytes("world", "robot", stamp_s=2))
        still_open.lookup_transform("world", "robot", 2_000_000_000, timeout_ns=LONG_NS)
        assert buffer.lookup_transform("world", "robot").stamp_ns == 1_000_000_000


def test_malformed_bytes_are_reported_once_and_the_rest_goes_on(domain, capfd):
    topic = f"/tf_of_{type(domain.sender).__name__}"  # each topic is reported once in a process
    publisher = domain.talker.create_publisher(topic, TYPE, QOS)
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver, topic=topic):
        domain.wait_for_subscriptions(publisher)
        for _ in range(3):
            publisher.publish(b"\x00\x01\x00\x00\xff\xff\xff\xff")
        publisher.publish(tf_bytes("world", "robot"))
        buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
        assert domain.receiver.graph.wait_for(
            lambda: faults.malformed(buffer).sender == "/talker", LONG_NS
        )
    assert capfd.readouterr().err.count(f"a message on {topic} was lost") == 1
    assert faults.malformed(buffer).messages == 3
    assert faults.malformed(buffer).last.startswith("4294967295 transforms are announced")


def test_each_refused_frame_is_logged_once_for_each_reason(domain, monkeypatch):
    kind = type(domain.sender).__name__
    arm, hand = f"arm_{kind}", f"hand_{kind}"
    logged = queue.Queue()
    monkeypatch.setattr(report, "warn", logged.put)
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.tf.publish(tf_bytes("world", "robot", stamp_s=1))
        buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
        assert domain.receiver.graph.wait_for(
            lambda: [each.name for link in links(buffer) for each in link.senders] == ["/talker"],
            LONG_NS,
        )
        for stamp_s in range(3):
            domain.tf.publish(tf_bytes("world", arm, x=math.nan, stamp_s=stamp_s))
        domain.tf.publish(tf_bytes(hand, hand))
        first, second = (logged.get(timeout=60) for _ in range(2))
        domain.tf.publish(tf_bytes(arm, arm))
        third = logged.get(timeout=60)
    assert first == (
        f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{arm}" from authority "/talker" '
        "because of a nan value in the transform (nan 0.000000 0.000000) "
        "(0.000000 0.000000 0.000000 1.000000)"
    )
    for text, frame in ((second, hand), (third, arm)):
        assert text == (
            'TF_SELF_TRANSFORM: Ignoring transform from authority "/talker" with frame_id and  '
            f'child_frame_id "{frame}" because they are the same'
        )
    assert logged.empty()


def test_a_refused_latched_transform_is_logged(domain, monkeypatch):
    frame = f"fixed_{type(domain.sender).__name__}"
    logged = queue.Queue()
    monkeypatch.setattr(report, "warn", logged.put)
    domain.tf_static.publish(tf_bytes("", frame))
    with TransformListener(Buffer(), domain.node, context=domain.receiver):
        assert logged.get(timeout=60).startswith(
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{frame}"'
        )


class Warnings:
    """Waits for warnings that name a topic."""

    def __init__(self, topic, monkeypatch):
        self._topic = topic
        self._news = threading.Condition()
        self.count = 0
        monkeypatch.setattr(refusal_warnings, "warn", self._warn)

    def _warn(self, text):
        assert text.startswith(f"a buffer that {self._topic} fills has max_frames=2 frames")
        with self._news:
            self.count += 1
            self._news.notify_all()

    def wait_for(self, count, timeout=60):
        with self._news:
            return self._news.wait_for(lambda: self.count == count, timeout)


def take_another(buffer, publisher):
    """Publish another pose of a frame, and wait until the full buffer has it."""
    changed = threading.Event()
    remove = buffer.on_change(changed.set)
    publisher.publish(tf_bytes("world", "robot", x=9.0, stamp_s=9))
    while buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS).x != 9.0:
        assert changed.wait(60)
        changed.clear()
    remove()


@pytest.fixture
def filled(domain, monkeypatch, request):
    """A full buffer, the publishers that filled it and refilled it, and the warnings."""
    topic = f"/full_{request.param}_{type(domain.sender).__name__}"
    publishers = [
        domain.sender.create_node(name).create_publisher(topic, TYPE, QOS)
        for name in ("first", "second")
    ]
    warnings, buffer = Warnings(topic, monkeypatch), Buffer(max_frames=2)
    topics = {"topic": topic} if request.param == "tf" else {"topic": None, "static_topic": topic}
    with TransformListener(buffer, domain.node, context=domain.receiver, static_qos=QOS, **topics):
        for publisher in publishers:
            domain.wait_for_subscriptions(publisher)
        yield buffer, publishers, warnings


@pytest.mark.parametrize("filled", ["tf", "static"], indirect=True)
def test_a_full_buffer_is_warned_of_once_in_a_while(filled):
    buffer, (publisher, _), warnings = filled
    for number in range(5):
        publisher.publish(tf_bytes("world", "robot", stamp_s=number + 1))
        publisher.publish(tf_bytes("world", f"invented{number}"))
    assert warnings.wait_for(1)
    take_another(buffer, publisher)
    assert buffer.frames() == ["robot", "world"]
    assert warnings.count == 1


@pytest.mark.parametrize("filled", ["tf", "static"], indirect=True)
def test_a_full_buffer_is_warned_of_again_if_it_refuses_more(filled, monkeypatch):
    monkeypatch.setattr(refusal_warnings, "_PERIOD_S", 0.0)
    buffer, publishers, warnings = filled
    for number in range(4):  # each publisher, a second time as well
        publisher = publishers[number % 2]
        publisher.publish(tf_bytes("world", "robot", stamp_s=number + 1))
        attempts = 0
        while not warnings.wait_for(number + 1, 0.1):
            publisher.publish(tf_bytes("world", "invented", stamp_s=attempts))
            attempts += 1
            assert attempts < 600
        assert buffer.is_full
    # what it takes is no reason for a warning, although it is full
    take_another(buffer, publishers[0])
    assert warnings.count == 4


def test_the_buffer_knows_who_publishes(domain):
    other = domain.sender.create_node("other", "/robot1")
    domain.tf_static.publish(tf_bytes("world", "wall"))
    other_tf = other.create_publisher("/tf", TYPE, QOS)
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver):
        domain.wait_for_subscriptions(domain.tf)
        domain.wait_for_subscriptions(other_tf)
        domain.tf.publish(tf_bytes("world", "robot"))
        other_tf.publish(tf_bytes("world", "cart"))
        for frame in ("wall", "robot", "cart"):
            buffer.lookup_transform("world", frame, None, timeout_ns=LONG_NS)

        def senders():
            return {
                link.child_frame: [sender.name for sender in link.senders] for link in links(buffer)
            }

        known = {"wall": ["/talker"], "robot": ["/talker"], "cart": ["/robot1/other"]}
        assert domain.receiver.graph.wait_for(lambda: senders() == known, LONG_NS), senders()
        assert "broadcaster: '/robot1/other'" in buffer.to_yaml()


def test_two_publishers_of_one_frame_are_told_apart(domain):
    other_tf = domain.sender.create_node("other").create_publisher("/tf", TYPE, QOS)
    buffer = Buffer()
    with TransformListener(buffer, domain.node, context=domain.receiver):
        for publisher, stamp in ((domain.tf, 1), (other_tf, 2)):
            domain.wait_for_subscriptions(publisher)
            publisher.publish(tf_bytes("world", "robot", stamp_s=stamp))
            buffer.lookup_transform("world", "robot", stamp * 1_000_000_000, timeout_ns=LONG_NS)
        assert domain.receiver.graph.wait_for(
            lambda: (
                [conflict.text for conflict in faults.conflicts(buffer)]
                == [
                    (
                        "'robot' is sent by '/other' and '/talker'; each frame should have one "
                        "publisher."
                    )
                ]
            ),
            LONG_NS,
        )


def test_listeners_may_be_closed_after_their_context(domain):
    first, second = (
        TransformListener(Buffer(), domain.node, context=domain.receiver) for _ in range(2)
    )
    domain.receiver.close()
    first.close()
    second.close()


def test_a_closed_context_is_not_kept_alive(domain):
    context = wire.open_context(middleware="local")
    node = context.create_node("short")
    TransformListener(Buffer(), node, context=context).close()
    node.close()
    context.close()
    gone = weakref.ref(context)
    del context, node
    gc.collect()
    assert gone() is None


def test_alone_it_joins_the_domain_of_the_environment(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    sender = wire.open_context(int(os.environ["ROS_DOMAIN_ID"]))
    publisher = sender.create_node("talker").create_publisher("/tf", TYPE, QOS)
    buffer = Buffer()
    with TransformListener(buffer):
        publisher.publish(tf_bytes("world", "robot"))
        buffer.lookup_transform("world", "robot", None, timeout_ns=LONG_NS)
        with TransformListener(Buffer()):
            talker, *listeners = [node.name for node in sender.graph.nodes()]
            assert talker == "talker"
            # Nodes of one name in two processes would be a conflict that users are warned of.
            assert len(set(listeners)) == 2
            assert all(name.startswith("transform_listener_impl_") for name in listeners)
    assert [node.name for node in sender.graph.nodes()] == ["talker"]
    sender.close()


# A simulation that starts again is noticed, and only that.


SECOND = 1_000_000_000
POSE = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


def test_a_world_that_begins_anew_is_forgotten():
    buffer = Buffer()
    restarts = RestartWatch(buffer)
    buffer.set_static_transform("world", "base", *POSE)
    buffer.set_transform("world", "robot", 100 * SECOND, *POSE)
    assert not restarts.look()
    with pytest.raises(InvalidTransformError, match="TF_OLD_DATA"):
        buffer.set_transform("world", "robot", SECOND, *POSE)
    buffer.set_transform("world", "robot", 101 * SECOND, *POSE)
    assert not restarts.look()  # one late message; it still goes on
    with pytest.raises(InvalidTransformError):
        buffer.set_transform("world", "robot", 2 * SECOND, *POSE)
    assert restarts.look()
    buffer.set_transform("world", "robot", 3 * SECOND, *POSE)
    assert not restarts.look()
    assert buffer.lookup_transform("world", "robot").stamp_ns == 3 * SECOND
    assert buffer.can_transform("world", "base")
