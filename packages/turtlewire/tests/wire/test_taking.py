"""Both ways of taking messages out of a Cyclone reader, by native code and through ctypes, give the
same.

Both ways of writing messages, by native code and through ctypes, do the same.
"""

from __future__ import annotations

from array import array

import pytest
from tests.needs import needs_cyclone_dds

from turtlewire import wire
from turtlewire.wire.base import EventKind, TypeId
from turtlewire.wire.cyclone import samples
from turtlewire.wire.qos import History, QoS

pytestmark = needs_cyclone_dds

STRING = TypeId(
    "std_msgs/msg/String", "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
)
LONG_NS = 60_000_000_000


def cdr(number, size):
    text = str(number).encode().ljust(size, b".") + b"\0"
    return b"\0\1\0\0" + len(text).to_bytes(4, "little") + text


WAYS = {"ctypes": samples.take_with_ctypes}
if samples.take_messages is not samples.take_with_ctypes:
    WAYS["native"] = samples.take_messages


@pytest.fixture
def pair(context):
    node = context.create_node("node")
    qos = QoS(history=History.KEEP_ALL)
    publisher, subscription = (
        node.create_publisher("/texts", STRING, qos),
        node.create_subscription("/texts", STRING, qos),
    )
    assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG_NS)
    return publisher, subscription


@pytest.mark.parametrize("take", list(WAYS.values()), ids=list(WAYS))
@pytest.mark.parametrize("limit", [1, 31, 32, 33, 64, 1000])
def test_messages_come_whole_in_order_and_no_more_than_asked_for(pair, take, limit):
    publisher, subscription = pair
    sent = [cdr(number, size=1 << number % 17) for number in range(70)]
    for message in sent:
        publisher.publish(message)
    taken, sizes = [], []
    while some := take(subscription.handle, limit):
        taken += some
        sizes.append(len(some))
    assert [data[: len(message)] for message, (data, _, _) in zip(sent, taken, strict=True)] == sent
    assert len({publisher for _, publisher, _ in taken}) == 1
    stamps = [stamp for _, _, stamp in taken]
    assert stamps == sorted(stamps)
    assert max(sizes) <= limit
    assert all(size == limit for size in sizes[:-1])


@pytest.mark.parametrize("take", list(WAYS.values()), ids=list(WAYS))
def test_there_is_nothing_in_an_empty_or_closed_reader(pair, take):
    publisher, subscription = pair
    assert take(subscription.handle, 10) == []
    publisher.publish(cdr(1, 1))
    assert take(subscription.handle, 0) == []
    assert len(take(subscription.handle, 10)) == 1
    publisher.publish(cdr(2, 1))
    subscription.close()
    assert take(subscription.handle, 10) == []
    assert subscription.take() == []


def waiter_for_publishers(context, subscription):
    """Return a function that waits until the reader thread has seen this many publishers."""
    matched = subscription.create_event(EventKind.MATCHED)
    wait_set = context.create_wait_set()
    wait_set.attach(matched)

    def wait(count):
        while (status := matched.take()) is None or status.current_count != count:
            wait_set.wait(LONG_NS)

    return wait


def test_publishers_that_left_are_forgotten(context, pair):
    """Peers come and go for weeks.

    The caches of their gids and user data must not grow with them.
    """
    _, subscription = pair
    wait_set = context.create_wait_set()
    wait_set.attach(subscription)
    wait_for_publishers = waiter_for_publishers(context, subscription)
    node = context.create_node("other")
    gids = []
    for number in range(11):
        publisher = node.create_publisher("/texts", STRING, QoS())
        wait_for_publishers(2)
        publisher.publish(cdr(number, size=8))
        assert wait_set.wait(LONG_NS) == [subscription]
        [(_, info)] = subscription.take()
        assert info.publisher_gid == publisher.gid
        gids.append(publisher.gid)
        publisher.close()
        wait_for_publishers(1)
        assert subscription.user_data_of(publisher.gid) != b""
    assert subscription.take() == []
    assert subscription._gids == {}
    assert [gid for gid in gids if subscription.user_data_of(gid)] == []


def test_waiting_messages_keep_the_gid_of_a_left_publisher(context, pair):
    _, subscription = pair
    wait_for_publishers = waiter_for_publishers(context, subscription)
    publisher = context.create_node("other").create_publisher("/texts", STRING, QoS())
    wait_for_publishers(2)
    for number in range(8):
        publisher.publish(cdr(number, size=8))
    [(_, info)] = subscription.take(1)
    assert info.publisher_gid == publisher.gid
    publisher.close()
    wait_for_publishers(1)
    for _ in range(7):
        [(_, info)] = subscription.take(1)
        assert info.publisher_gid == publisher.gid
    assert subscription.take(1) == []
    assert subscription._gids == {}


def with_ctypes(handle: int) -> samples.CtypesWriter:
    return samples.CtypesWriter(handle, samples.sertype_of(handle))


WRITERS = {"ctypes": with_ctypes}
if samples.NATIVE is not None:
    WRITERS["native"] = samples.make_writer


@pytest.fixture(params=list(WRITERS.values()), ids=list(WRITERS))
def written(request):
    """A writer, and a subscription that receives what it sends."""
    context = wire.open_context(middleware="rmw_cyclonedds_cpp")
    node = context.create_node("node")
    qos = QoS(history=History.KEEP_ALL)
    publisher = node.create_publisher("/texts", STRING, qos)
    subscription = node.create_subscription("/texts", STRING, qos)
    assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG_NS)
    yield request.param(publisher.handle), subscription
    context.close()


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5, 1000, 1_000_001])
def test_bytes_arrive_padded_to_four(written, size):
    writer, subscription = written
    message = b"\0\1\0\0" + bytes(index % 251 for index in range(size))
    assert writer.write(message) == 0
    [(data, _)] = subscription.take()
    assert data == message + bytes(-len(message) % 4)


@pytest.mark.parametrize("count", [1, 2, 14, 15, 16, 40])
def test_the_parts_of_a_message_arrive_as_one(written, count):
    writer, subscription = written
    parts = [array("H", range(index)) for index in range(count)]
    assert writer.write((bytearray(b"\0\1\0\0text"), *parts)) == 0
    [(data, _)] = subscription.take()
    message = b"\0\1\0\0text" + b"".join(parts)
    assert data == message + bytes(-len(message) % 4)


def test_the_parts_of_a_message_may_change_after_it_was_sent(written):
    writer, subscription = written
    numbers = array("I", [1, 2, 3])
    assert writer.write((b"\0\1\0\0", numbers)) == 0
    numbers.append(4)  # BufferError while anything holds its memory
    [(data, _)] = subscription.take()
    assert data == b"\0\1\0\0" + numbers[:3].tobytes()


@pytest.mark.parametrize("cdr", [None, 3, "text", (b"\0\1\0\0", 3)])
def test_objects_without_a_buffer_are_rejected(written, cdr):
    writer, _ = written
    with pytest.raises(TypeError):
        writer.write(cdr)


@pytest.mark.parametrize("data", [b"", b"\0\1\0\0", b"\0\0\0\0abcd", b"\1\1\0\0abcd"])
def test_bytes_that_are_no_message_are_refused(written, data):
    writer, subscription = written
    assert writer.write(data) == samples.NO_MESSAGE
    assert subscription.take() == []


def test_a_closed_writer_sends_nothing(written):
    writer, subscription = written
    writer.close()
    writer.close()
    assert writer.write(b"\0\1\0\0abcd") == samples.CLOSED
    assert subscription.take() == []
