"""Passing batches of a channel to a native sink."""

from __future__ import annotations

import struct
import threading
from types import SimpleNamespace

import pytest
from tests.needs import COMPILED_CORE

from turtlewire import Buffer, msg
from turtlewire.tf.buffer import CORE
from turtlewire.tf.listener import QOS, TYPE_NAME
from turtlewire.wire import open_context
from turtlewire.wire.base import EventKind, TypeId

if CORE != "native":
    pytest.skip(COMPILED_CORE, allow_module_level=True)

from turtlewire._native import Intake, ZenohInlet

GID, OTHER = bytes(range(16)), bytes(range(16, 32))
TYPE = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
LONG_NS = 60_000_000_000


def tf_bytes(stamp_s: int, frames: int = 1) -> bytes:
    made = []
    for number in range(frames):
        transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
        transform.header.frame_id, transform.child_frame_id = "world", f"robot{number}"
        transform.header.stamp.sec = stamp_s
        made.append(transform)
    return msg.serialize(msg.get_message(TYPE_NAME)(transforms=made))


def attachment(number: int, gid: bytes = GID) -> bytes:
    return struct.pack("<qqB16s", number, 1000, 16, gid)


def named_attachment(number: int) -> bytes:
    """That of rmw_zenoh_cpp 0.2.0 to 0.2.3."""
    return b"".join(
        (
            b"\x0fsequence_number" + struct.pack("<q", number),
            b"\x10source_timestamp" + struct.pack("<q", 1000),
            b"\x0asource_gid\x10" + GID,
        )
    )


def sample(payload: bytes, beside: bytes | None) -> SimpleNamespace:
    """Return a stand-in for a zenoh.Sample with the attributes that are read."""
    return SimpleNamespace(
        payload=SimpleNamespace(to_bytes=lambda: payload),
        attachment=None if beside is None else SimpleNamespace(to_bytes=lambda: beside),
    )


class Taking:
    """An intake into one buffer behind an inlet."""

    def __init__(self) -> None:
        self.buffer = Buffer(None)
        self.intake = Intake(False, 0, lambda number, gid_of: (gid_of(number), "/talker"), print)
        self.intake.feed((self.buffer,))
        self.inlet = ZenohInlet(self.intake)

    def stamps(self, frame: str = "robot0") -> list[int]:
        assert self.intake.serve(self.inlet.gid_of) == []
        return [stamp // 1_000_000_000 for stamp in self.buffer.samples(frame)[0][1].tolist()]


def test_a_batch_goes_in_with_one_call_in_order():
    taking = Taking()
    batch = [sample(tf_bytes(stamp_s), attachment(stamp_s)) for stamp_s in range(1, 51)]
    assert taking.inlet.receive(batch) == (True, 0, [])
    assert taking.stamps() == list(range(1, 51))


def test_a_batch_that_is_long_goes_in_without_the_gil():
    taking = Taking()
    batch = [sample(tf_bytes(stamp_s, frames=300), attachment(stamp_s)) for stamp_s in (1, 2, 3)]
    assert taking.inlet.receive(batch) == (True, 0, [])
    assert taking.stamps("robot299") == [1, 2, 3]


def test_both_layouts_of_attachments_are_read():
    taking = Taking()
    batch = [sample(tf_bytes(1), named_attachment(1)), sample(tf_bytes(2), attachment(2))]
    assert taking.inlet.receive(batch) == (True, 0, [])
    assert taking.stamps() == [1, 2]
    assert taking.inlet.gid_of(int.from_bytes(GID[:8], "little")) == GID


@pytest.mark.parametrize(
    ("payload", "beside"),
    [
        (tf_bytes(2), None),
        (tf_bytes(2), b""),
        (tf_bytes(2), attachment(2)[:-1]),
        (tf_bytes(2), attachment(2)[:16] + b"\x11" + GID),
        (b"", attachment(2)),
        (b"\0\1\0\0", attachment(2)),
    ],
)
def test_invalid_messages_are_returned_and_the_rest_stored(payload, beside):
    taking = Taking()
    strange = sample(payload, beside)
    batch = [sample(tf_bytes(1), attachment(1)), strange, sample(tf_bytes(3), attachment(2))]
    serve, lost, refused = taking.inlet.receive(batch)
    assert (serve, lost) == (True, 0)
    assert refused == [strange]
    assert taking.stamps() == [1, 3]


def test_missing_numbers_are_counted_for_each_publisher():
    taking = Taking()
    inlet = taking.inlet

    def lost(number: int, gid: bytes = GID) -> int:
        return inlet.receive([sample(tf_bytes(1), attachment(number, gid))])[1]

    assert [lost(5), lost(6), lost(9), lost(9), lost(2), lost(3)] == [0, 0, 2, 0, 0, 0]
    assert [lost(7, OTHER), lost(9, OTHER), lost(4)] == [0, 1, 0]
    inlet.forget(GID)
    assert [lost(100), lost(102), lost(12, OTHER)] == [0, 1, 2]
    assert [lost(-(2**63)), lost(2**63 - 1)] == [0, 2**64 - 2]


def test_the_gid_of_a_publisher_that_never_sent_is_empty():
    taking = Taking()
    inlet = taking.inlet
    inlet.forget(GID)
    assert inlet.gid_of(int.from_bytes(GID[:8], "little")) == b""


@pytest.fixture
def nodes():
    contexts = [open_context(middleware="rmw_zenoh_cpp") for _ in range(2)]
    yield [context.create_node("node") for context in contexts]
    for context in contexts:
        context.close()


def test_subscription_without_callback_is_ready_until_drained(nodes):
    sender, receiver = nodes
    taking = Taking()
    publisher = sender.create_publisher("/tf", TYPE, QOS)
    subscription = receiver.create_subscription("/tf", TYPE, QOS, None, taking.intake)
    assert sender.context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG_NS)
    wait_set = receiver.context.create_wait_set()
    wait_set.attach(subscription)
    publisher.publish(tf_bytes(1))
    assert wait_set.wait(LONG_NS) == [subscription]
    assert subscription.take() == []
    assert taking.stamps() == [1]
    publisher.publish(b"\0\1\0\0\xff\xff\xff\xff")
    assert wait_set.wait(LONG_NS) == [subscription]
    [(data, info)] = subscription.take()
    assert data[4:8] == b"\xff\xff\xff\xff"
    assert info.publisher_gid == publisher.gid
    assert wait_set.wait(LONG_NS) == [subscription]
    assert subscription.take() == []
    assert wait_set.wait(0) == []


def test_lost_messages_are_reported(nodes):
    sender, receiver = nodes
    taking, said = Taking(), threading.Event()
    publisher = sender.create_publisher("/tf", TYPE, QOS)
    subscription = receiver.create_subscription(
        "/tf", TYPE, QOS, lambda *_: said.set(), taking.intake
    )
    assert sender.context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG_NS)
    lost = subscription.create_event(EventKind.MESSAGE_LOST)
    wait_set = receiver.context.create_wait_set()
    wait_set.attach(lost)
    publisher.publish(tf_bytes(1))
    for _ in range(3):
        next(publisher._numbers)
    publisher.publish(tf_bytes(2))
    assert wait_set.wait(LONG_NS) == [lost]
    assert lost.take().total_count_change == 3


def test_a_batch_that_changes_while_it_is_read_is_read_to_its_end():
    class Vanishing:
        payload = SimpleNamespace(to_bytes=lambda: tf_bytes(1))

        @property
        def attachment(self) -> None:
            batch.clear()

    taking = Taking()
    batch = [Vanishing(), *(sample(tf_bytes(stamp), attachment(stamp)) for stamp in (1, 2))]
    vanishing = batch[0]
    assert taking.inlet.receive(batch) == (True, 0, [vanishing])
    assert taking.stamps() == [1, 2]
