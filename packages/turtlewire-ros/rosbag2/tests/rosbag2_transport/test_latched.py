"""Latched messages that are missing after a seek of a playback."""

import pytest

from rosbag2_transport.latched import Latched
from rosbag2_transport.played_bags import PlayedBags
from turtlewire.bag import BagWriter

SECOND = 1_000_000_000


@pytest.fixture
def latched(tmp_path):
    """The latched messages of a bag; of each its log time, and the time at which it was sent."""
    bags = []

    def make(*times, depth=10, storage="mcap"):
        with BagWriter(tmp_path / "bag", storage=storage) as writer:
            writer.add_topic("/other", "std_msgs/msg/String")
            writer.add_topic("/map", "std_msgs/msg/String")
            writer.write("/other", bytes(8), 0)
            for received, sent in times:
                writer.write("/map", bytes(8), received, sent)
        bags.append(PlayedBags([str(tmp_path / "bag")]))
        return Latched(bags[-1], {"/map": depth})

    yield make
    for bag in bags:
        bag.close()


def times(messages):
    return [message.log_time_ns for message in messages]


def test_each_move_sends_what_is_new_before_its_time(latched):
    sent = latched((10, 10), (20, 20), (30, 30))
    for time, expected in (
        (10, []),  # the message of this time is still to come
        (11, [10]),
        (12, []),
        (20, []),
        (31, [20, 30]),
        (40, []),
        (30, [10, 20]),  # so that the one of 20 is the newest again
        (30, []),
        (40, [30]),
    ):
        assert times(sent.move(time)) == expected, time
    sent.forget()
    assert times(sent.move(25)) == [10, 20]


@pytest.mark.parametrize(("depth", "kept"), [(1, [30]), (2, [20, 30]), (3, [10, 20, 30])])
def test_no_more_than_listeners_keep(latched, depth, kept):
    sent = latched((10, 10), (20, 20), (30, 30), depth=depth)
    assert times(sent.move(31)) == kept
    assert times(sent.move(31)) == []


def test_messages_that_are_played_count_as_sent(latched):
    sent = latched((10, 10), (20, 20), (30, 30))
    assert sent.move(0) == []
    for _ in range(2):
        assert not sent.is_known("/map")
        sent.pass_by("/map")
    assert sent.move(25) == []
    assert times(sent.move(31)) == [30]
    assert not sent.is_known("/other")


def test_a_message_sent_before_and_received_later_is_sent_once(latched):
    sent = latched((10, 2), (11, 4), (12, 5), (13, 3))
    assert times(sent.move(5, look_ahead=True)) == [10, 11], "the third one was sent at 5"
    for _ in range(2):
        assert sent.is_known("/map")
        sent.pass_by("/map")
    assert not sent.is_known("/map")
    assert times(sent.move(6, look_ahead=True)) == [12, 13]
    assert sent.move(6) == []


def test_a_database_counts_what_is_received_within_a_second(latched):
    received = (SECOND // 2, SECOND, SECOND + 1)
    sent = latched(*((time, time) for time in received), storage="sqlite3")
    assert times(sent.move(0, look_ahead=True)) == [SECOND // 2, SECOND]
    assert times(sent.move(1, look_ahead=True)) == [SECOND + 1]
