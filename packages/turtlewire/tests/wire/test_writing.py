"""Both ways of writing messages, by native code and through ctypes, do the same."""

from __future__ import annotations

from array import array

import pytest
from tests.needs import needs_cyclone_dds

from turtlewire import wire
from turtlewire.wire.base import TypeId
from turtlewire.wire.cyclone import writing
from turtlewire.wire.cyclone.sertype import sertype_of
from turtlewire.wire.qos import History, QoS

pytestmark = needs_cyclone_dds

STRING = TypeId(
    "std_msgs/msg/String", "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
)
LONG_NS = 60_000_000_000


def with_ctypes(handle: int) -> writing.CtypesWriter:
    return writing.CtypesWriter(handle, sertype_of(handle))


WAYS = {"ctypes": with_ctypes}
if writing.NATIVE is not None:
    WAYS["native"] = writing.make_writer


@pytest.fixture(params=list(WAYS.values()), ids=list(WAYS))
def pair(request):
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
def test_bytes_arrive_padded_to_four(pair, size):
    writer, subscription = pair
    message = b"\0\1\0\0" + bytes(index % 251 for index in range(size))
    assert writer.write(message) == 0
    [(data, _)] = subscription.take()
    assert data == message + bytes(-len(message) % 4)


@pytest.mark.parametrize("count", [1, 2, 14, 15, 16, 40])
def test_the_parts_of_a_message_arrive_as_one(pair, count):
    writer, subscription = pair
    parts = [array("H", range(index)) for index in range(count)]
    assert writer.write((bytearray(b"\0\1\0\0text"), *parts)) == 0
    [(data, _)] = subscription.take()
    message = b"\0\1\0\0text" + b"".join(parts)
    assert data == message + bytes(-len(message) % 4)


def test_the_parts_of_a_message_may_change_after_it_was_sent(pair):
    writer, subscription = pair
    numbers = array("I", [1, 2, 3])
    assert writer.write((b"\0\1\0\0", numbers)) == 0
    numbers.append(4)  # BufferError while anything holds its memory
    [(data, _)] = subscription.take()
    assert data == b"\0\1\0\0" + numbers[:3].tobytes()


@pytest.mark.parametrize("cdr", [None, 3, "text", (b"\0\1\0\0", 3)])
def test_objects_without_a_buffer_are_rejected(pair, cdr):
    writer, _ = pair
    with pytest.raises(TypeError):
        writer.write(cdr)


@pytest.mark.parametrize("data", [b"", b"\0\1\0\0", b"\0\0\0\0abcd", b"\1\1\0\0abcd"])
def test_bytes_that_are_no_message_are_refused(pair, data):
    writer, subscription = pair
    assert writer.write(data) == writing.NO_MESSAGE
    assert subscription.take() == []


def test_a_closed_writer_sends_nothing(pair):
    writer, subscription = pair
    writer.close()
    writer.close()
    assert writer.write(b"\0\1\0\0abcd") == writing.CLOSED
    assert subscription.take() == []
