"""What a client has yet to receive: order, bounds, and one notice of a loss."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire_view.foxglove.outbox import Outbox


class Notes:
    """An outbox with the subscriptions 0 to 3, and what it called."""

    def __init__(self, limit=100):
        self.wakes, self.lost, self.floods = 0, [], 0
        self.outbox = Outbox(limit, self.wake, self.lost.append, self.flood)
        self.numbers = {}
        for subscription_id in range(4):
            self.begin(subscription_id)

    def begin(self, subscription_id):
        self.numbers[subscription_id] = self.outbox.begin(subscription_id)

    def put(self, subscription_id, time_ns, cdr):
        self.outbox.put(self.numbers[subscription_id], time_ns, cdr)

    def end(self, subscription_id):
        self.outbox.end(self.numbers[subscription_id])

    def wake(self):
        self.wakes += 1

    def flood(self):
        self.floods += 1

    def taken(self):
        frames = []
        while (frame := self.outbox.take()) is not None:
            frames.append(frame)
        return frames


def test_other_frames_go_first_then_the_newest_time_then_messages_in_order():
    notes = Notes()
    notes.put(1, 10, b"a")
    notes.outbox.set_time(b"old")
    notes.put(2, 11, b"b")
    notes.outbox.set_time(b"new")
    notes.outbox.send("first")
    notes.outbox.send(b"second")
    notes.put(1, 12, b"c")
    head = struct.Struct("<BIQ")
    assert notes.taken() == [
        "first",
        b"second",
        b"new",
        head.pack(1, 1, 10) + b"a",
        head.pack(1, 2, 11) + b"b",
        head.pack(1, 1, 12) + b"c",
    ]
    assert notes.wakes == 1
    notes.put(1, 13, b"d")
    notes.put(1, 14, b"e")
    assert notes.wakes == 2


def test_the_largest_topic_loses_its_oldest_messages_and_says_so_once():
    notes = Notes(limit=100)
    notes.put(1, 0, b"map")
    for number in range(10):
        notes.put(2, number, bytes([number]) * 40)
    notes.put(3, 0, bytes(500))  # larger than the limit, and its only message
    assert [frame[13:][:1] for frame in notes.taken()] == [b"m", b"\x09", b"\0"]
    assert notes.lost == [2]


@pytest.mark.parametrize(
    ("last", "kept"), [(0, [60, 40, 0]), (1, [40, 1]), (60, [40, 60]), (61, [61]), (101, [101])]
)
def test_messages_that_fit_exactly_are_kept(last, kept):
    notes = Notes(limit=100)
    notes.put(1, 0, bytes(60))
    notes.put(1, 1, bytes(40))
    notes.put(1, 2, bytes(last))
    assert notes.lost == ([] if last == 0 else [1])
    assert [len(frame) - 13 for frame in notes.taken()] == kept


def test_a_subscription_that_begins_again_tells_again_of_its_loss():
    notes = Notes(limit=100)
    for _ in range(2):
        for _ in range(3):
            notes.put(1, 0, bytes(60))
        notes.end(1)
        notes.begin(1)
    assert notes.lost == [1, 1]


def test_an_ended_subscription_leaves_nothing():
    notes = Notes()
    notes.put(1, 0, bytes(90))
    notes.end(1)
    assert notes.taken() == []
    notes.put(2, 0, bytes(60))
    notes.put(2, 0, bytes(30))
    assert not notes.lost
    notes.outbox.send("before the end")
    notes.outbox.set_time(b"before the end")
    assert not notes.outbox.is_empty
    notes.outbox.close()
    assert notes.outbox.is_empty
    notes.put(2, 0, b"")
    notes.outbox.send("late")
    notes.outbox.set_time(b"late")
    assert notes.taken() == []


def test_a_message_after_the_end_of_its_subscription_is_dropped():
    notes = Notes()
    ended = notes.numbers[1]
    notes.end(1)
    notes.outbox.put(ended, 0, b"from a thread of the wire")
    assert notes.outbox.is_empty
    notes.begin(1)  # the client uses the id again, for another topic
    notes.outbox.put(ended, 0, b"of the former topic")
    notes.put(1, 0, b"of the new topic")
    assert [frame[13:] for frame in notes.taken()] == [b"of the new topic"]


def test_a_client_that_reads_nothing_is_given_up():
    notes = Notes()
    for _ in range(499):
        notes.outbox.send("{}")
    assert not notes.outbox.is_crowded
    notes.outbox.send("{}")
    assert notes.outbox.is_crowded
    for _ in range(4499):
        notes.outbox.send("{}")
    assert notes.floods == 0
    for _ in range(2):
        notes.outbox.send("{}")
    assert notes.floods == 1
    assert notes.taken() == []


def test_large_frames_crowd_until_they_are_taken():
    notes = Notes()
    notes.outbox.send(bytes((1 << 20) - 1))
    assert not notes.outbox.is_crowded
    notes.outbox.send(b"1")
    assert notes.outbox.is_crowded
    notes.outbox.take()
    assert not notes.outbox.is_crowded


@given(
    st.lists(
        st.tuples(st.sampled_from(["put", "take", "forget"]), st.integers(0, 3), st.integers(0, 60))
    ),
    st.integers(1, 150),
)
def test_it_holds_at_most_the_limit_and_one_message_of_each_topic(steps, limit):
    notes = Notes(limit)
    model = {}
    newest = {}
    for number, (step, topic, size) in enumerate(steps):
        if step == "put":
            notes.put(topic, number, bytes(size))
            model.setdefault(topic, []).append(number)
            newest[topic] = size
        elif step == "forget":
            notes.end(topic)
            notes.begin(topic)
            model.pop(topic, None)
        else:
            notes.outbox.take()
    frames = [(*struct.unpack_from("<BIQ", frame), len(frame) - 13) for frame in notes.taken()]
    for topic in {topic for _, topic, _, _ in frames}:
        kept = [time for _, each, time, _ in frames if each == topic]
        assert kept == model[topic][-len(kept) :]  # the newest ones, in order
    held = sum(size for *_, size in frames)
    assert held <= limit or len({topic for _, topic, _, _ in frames}) == len(frames)
