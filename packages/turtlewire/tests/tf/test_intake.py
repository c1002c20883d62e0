"""The native path of transforms into buffers.

From the wire into the compiled core: on Cyclone's receiving thread without Python, from Zenoh's
channel in batches.
"""

import itertools
import sys
import threading

import pytest
from tests.needs import COMPILED_CORE

from turtlewire import Buffer, msg, wire
from turtlewire.tf import buffer as core
from turtlewire.tf import channel, faults
from turtlewire.tf.links import links
from turtlewire.tf.listener import QOS, STATIC_QOS, TYPE_NAME, TransformListener
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import History

from .conftest import tf_bytes

pytestmark = pytest.mark.skipif(core.CORE != "native", reason=COMPILED_CORE)

TYPE = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
KEEP_ALL = QOS._replace(history=History.KEEP_ALL)
LONG_NS = 60_000_000_000


def from_world(stamp_s, child="robot"):
    return tf_bytes("world", child, stamp_s=stamp_s)


class Flow:
    """One publisher and one listener; counts the messages that go through Python."""

    def __init__(self, monkeypatch, middleware):
        self.by_python = 0
        self.middleware = middleware
        self.sender, self.receiver = (wire.open_context(middleware=middleware) for _ in range(2))
        self.publisher = self.sender.create_node("talker").create_publisher("/tf", TYPE, KEEP_ALL)
        self.node = self.receiver.create_node("listener")
        self._stamps = itertools.count(1)
        self.identified = 0
        call, identify = channel.Feed.__call__, channel.Feed._identify

        def counted(feed, cdr, info):
            self.by_python += 1
            call(feed, cdr, info)

        def asked(feed, publisher, gid_of):
            self.identified += 1
            return identify(feed, publisher, gid_of)

        monkeypatch.setattr(channel.Feed, "__call__", counted)
        monkeypatch.setattr(channel.Feed, "_identify", asked)

    def listen(self, store, **choices):
        return TransformListener(store, self.node, context=self.receiver, qos=KEEP_ALL, **choices)

    def wait_for_match(self, count=1):
        assert self.sender.graph.wait_for(
            lambda: self.publisher.subscription_count() == count, LONG_NS
        )

    def send(self, buffer):
        """Send one transform and wait until it is in the buffer."""
        stamp_s = next(self._stamps)
        self.publisher.publish(from_world(stamp_s))
        buffer.lookup_transform("world", "robot", stamp_s * 1_000_000_000, timeout_ns=LONG_NS)

    def send_until_short(self, buffer):
        """Send until a message comes without Python: the publisher is known."""
        for _ in range(1000):
            before = self.by_python, self.identified
            self.send(buffer)
            if any(before) and (self.by_python, self.identified) == before:
                return
        raise AssertionError("all of 1000 messages went through Python")

    def close(self):
        self.sender.close()
        self.receiver.close()


@pytest.fixture(params=["rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
def flow(monkeypatch, request):
    flow = Flow(monkeypatch, request.param)
    yield flow
    flow.close()


def test_python_is_asked_once_for_each_publisher_and_sees_no_message(flow):
    buffer = Buffer()
    with flow.listen(buffer):
        flow.wait_for_match()
        for _ in range(50):
            flow.send(buffer)
    assert (flow.identified, flow.by_python) == (1, 0)


def test_an_expected_message_ends_a_wait_without_python_where_it_can(flow):
    buffer, calls = Buffer(), []
    wait_set = flow.receiver.create_wait_set()
    waker = wait_set.native_waker()
    assert (waker is None) == (flow.middleware == "rmw_zenoh_cpp")
    with flow.listen(buffer) as listening:
        flow.wait_for_match()
        flow.send_until_short(buffer)
        listening.on_message(lambda: (calls.append(1), wait_set.wake()))
        for _ in range(3):
            assert listening.take_arrivals()
            assert not listening.expect_message(waker)
            waiting = threading.Thread(target=wait_set.wait, daemon=True)
            waiting.start()
            flow.send(buffer)
            waiting.join(LONG_NS / 1e9)
            assert not waiting.is_alive()
        assert (calls == []) == (waker is not None)


def test_messages_during_the_name_lookup_need_no_python(flow, monkeypatch):
    """So that a machine under load finds back to the short way."""
    buffer = Buffer(None)
    busy, go = threading.Event(), threading.Event()
    identify = channel.Feed._identify

    def slow(feed, publisher, gid_of):
        busy.set()
        assert go.wait(60)
        return identify(feed, publisher, gid_of)

    monkeypatch.setattr(channel.Feed, "_identify", slow)
    with flow.listen(buffer):
        flow.wait_for_match()
        for stamp_s in range(1, 51):
            flow.publisher.publish(from_world(stamp_s))
            assert busy.wait(60)
        go.set()
        buffer.lookup_transform("world", "robot", 50_000_000_000, timeout_ns=LONG_NS)
        [(_, stamps, _)] = buffer.samples("robot")
        assert len(stamps) == 50
    assert (flow.identified, flow.by_python) == (1, 0)


def test_listeners_hear_of_what_was_stored_with_the_name(flow):
    buffer, heard = Buffer(), threading.Event()
    buffer.on_change(heard.set)
    with flow.listen(buffer):
        flow.wait_for_match()
        flow.publisher.publish(from_world(1))  # none follows that could wake them
        assert heard.wait(60)
        assert buffer.can_transform("world", "robot")


def test_the_count_of_messages_never_falls(flow):
    first, second = Buffer(), Buffer()
    former = flow.listen(first)
    with flow.listen(second) as staying:
        flow.wait_for_match()
        for _ in range(5):
            flow.send(second)
        counted = [channel.total() for channel in staying._seen]
        assert sum(counted) == 5
        former.close()  # which owned the subscription: a new one takes its place
        assert [channel.total() for channel in staying._seen] == counted
        flow.send_until_short(second)
        assert sum(channel.total() for channel in staying._seen) > sum(counted)


def test_a_publisher_that_nobody_can_name_is_heard_through_python(flow, monkeypatch):
    def failing(feed, publisher, gid_of):
        raise RuntimeError("no graph")

    faults = []
    monkeypatch.setattr(sys, "unraisablehook", lambda fault: faults.append(str(fault.exc_value)))
    monkeypatch.setattr(channel.Feed, "_identify", failing)
    buffer = Buffer()
    with flow.listen(buffer):
        flow.wait_for_match()
        flow.send(buffer)
    assert flow.by_python == 1
    assert faults == ["no graph"]


def test_nothing_is_lost_or_overtaken_while_publishers_are_introduced(flow):
    buffer = Buffer(None)
    publishers = [
        flow.sender.create_node(f"talker{i}").create_publisher("/tf", TYPE, KEEP_ALL)
        for i in range(3)
    ]
    count = 300
    with flow.listen(buffer):
        for publisher in publishers:
            assert flow.sender.graph.wait_for(
                lambda publisher=publisher: publisher.subscription_count() == 1, LONG_NS
            )

        def flood(number):
            for stamp_s in range(1, count + 1):
                publishers[number].publish(from_world(stamp_s, f"robot{number}"))

        threads = [threading.Thread(target=flood, args=(number,)) for number in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for number in range(3):
            buffer.lookup_transform(
                "world", f"robot{number}", count * 1_000_000_000, timeout_ns=LONG_NS
            )
            [(_, stamps, _)] = buffer.samples(f"robot{number}")
            assert stamps.tolist() == [stamp_s * 1_000_000_000 for stamp_s in range(1, count + 1)]
    assert not faults.refusals(buffer)


def test_change_listeners_are_called_on_the_reader_thread(flow):
    buffer = Buffer()
    called, threads = threading.Event(), []

    def on_change():
        threads.append(threading.current_thread().name)
        called.set()

    with flow.listen(buffer):
        flow.wait_for_match()
        flow.send_until_short(buffer)
        stop = buffer.on_change(on_change)
        seen = flow.by_python
        for _ in range(5):
            called.clear()
            flow.send(buffer)
            assert called.wait(60)
        assert flow.by_python == seen
        assert set(threads) == {"turtlewire-reader"}
        stop()
        calls = len(threads)
        flow.send(buffer)
        flow.receiver.close()  # which joins its threads: whatever it had to call has been called
        assert len(threads) <= calls + 1  # one may have been on its way


def test_a_malformed_message_between_good_ones_is_counted_with_its_sender(flow):
    buffer = Buffer()
    with flow.listen(buffer):
        flow.wait_for_match()
        flow.send_until_short(buffer)
        flow.publisher.publish(b"\x00\x01\x00\x00\xff\xff\xff\xff")
        flow.send(buffer)
        assert faults.malformed(buffer).messages == 1
        flow.send_until_short(buffer)
        while faults.malformed(buffer).sender != "/talker":  # it is named a little later
            flow.send(buffer)


def test_stores_of_other_kinds_are_served_beside_buffers(flow):
    class Store(Buffer):
        def __init__(self):
            super().__init__()
            self.messages = 0

        def add_tf_message(self, cdr, **how):
            self.messages += 1
            return super().add_tf_message(cdr, **how)

    buffer, store = Buffer(), Store()
    with flow.listen(buffer):
        flow.wait_for_match()
        flow.send_until_short(buffer)
        with flow.listen(store):
            for _ in range(10):
                flow.send(store)
            assert store.messages == 10
        flow.send_until_short(buffer)


def test_latched_transforms_take_part(flow):
    static = flow.sender.create_node("walls").create_publisher(
        "/tf_static", TYPE, STATIC_QOS._replace(depth=10)
    )
    for number in range(10):
        static.publish(from_world(1, f"wall{number}"))
    buffers = [Buffer() for _ in range(3)]
    for buffer in buffers:  # each begins a new subscription, with what was published before
        with flow.listen(buffer):
            for number in range(10):
                buffer.lookup_transform("world", f"wall{number}", None, timeout_ns=LONG_NS)
        assert {link.senders[0].name for link in links(buffer)} <= {"/walls", static.gid.hex()}


def test_listeners_and_contexts_close_in_the_middle_of_the_stream(flow):
    stop = threading.Event()
    volatile = flow.sender.create_node("flood").create_publisher("/tf", TYPE, QOS)

    def flood():
        for stamp_s in itertools.count(1):
            if stop.is_set():
                return
            volatile.publish(from_world(stamp_s % 1_000_000_000))

    thread = threading.Thread(target=flood)
    thread.start()
    try:
        for number in range(20):
            context = wire.open_context(middleware=flow.middleware)
            buffers = [Buffer() for _ in range(3)]
            node = context.create_node("listener")
            listeners = [TransformListener(buffer, node, context=context) for buffer in buffers]
            for buffer in buffers:
                assert buffer.can_transform("world", "robot", None, timeout_ns=LONG_NS)
            for opened in listeners if number % 2 else ():
                opened.close()
            context.close()
            newest = [buffer._latest_common_time("world", "robot") for buffer in buffers]
            flow.publisher.publish(from_world(1))
            assert newest == [buffer._latest_common_time("world", "robot") for buffer in buffers]
    finally:
        stop.set()
        thread.join()


@pytest.mark.parametrize("flow", ["rmw_cyclonedds_cpp"], indirect=True)
def test_the_gids_of_publishers_that_left_are_forgotten(flow):
    buffer = Buffer()
    with flow.listen(buffer, static_topic=None) as listening:
        [channel] = listening._joined
        subscription = channel._subscription
        flow.wait_for_match()
        for number in range(5):
            guest = flow.sender.create_node(f"guest{number}").create_publisher(
                "/tf", TYPE, KEEP_ALL
            )
            assert flow.sender.graph.wait_for(
                lambda guest=guest: guest.subscription_count() == 1, LONG_NS
            )
            guest.publish(from_world(1, f"guest{number}"))
            assert buffer.can_transform("world", f"guest{number}", None, timeout_ns=LONG_NS)
            guest.close()
            assert flow.receiver.graph.wait_for(
                lambda: subscription.publisher_count() == 1, LONG_NS
            )
        assert len(subscription._gids) <= 3  # the last ones may still be on their way out
