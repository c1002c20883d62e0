"""Several bags in one playback, the order of their messages, and what is latched after a seek."""

import argparse

import pytest

import rosbag2_py
from ros2bag import api
from ros2bag.options import bags_to_play
from ros2cli.main import main
from rosbag2_py import MessageOrder, PlayOptions, StorageOptions
from rosbag2_transport.played_bags import Latched, PlayedBags
from std_msgs.msg import String
from turtlewire.bag import BagWriter

from .conftest import DEEP

START = 1_800_000_000_000_000_000
MS = 1_000_000


@pytest.fixture
def bags(tmp_path):
    """Writes bags; each message is a topic, and when it was received and sent [ms]."""

    def write(*contents, storage="mcap"):
        paths = []
        for number, content in enumerate(contents):
            paths.append(str(tmp_path / f"bag{number}"))
            with BagWriter(paths[-1], storage=storage) as writer:
                for topic in dict.fromkeys(topic for topic, *_ in content):
                    writer.add_topic(topic, "std_msgs/msg/String")
                for topic, received, sent in content:
                    text = String(data=f"{number}{topic}{sent}")
                    writer.write(topic, text, START + received * MS, START + sent * MS)
        return paths

    return write


def texts(messages):
    return [message.decode().data for message in messages]


TWO = ([("/a", 0, 0), ("/b", 20, 20), ("/b", 40, 40)], [("/a", 10, 10), ("/c", 50, 50)])


def test_bags_are_one(bags):
    paths = bags(*TWO)
    played = PlayedBags(paths)
    try:
        assert (played.start_ns, played.end_ns) == (START, START + 50 * MS)
        assert set(played.topics) == {"/a", "/b", "/c"}
        assert texts(played.messages(["/a", "/b", "/c"])) == [
            "0/a0",
            "1/a10",
            "0/b20",
            "0/b40",
            "1/c50",
        ]
        some = played.messages(["/b", "/c"], start_ns=START + 30 * MS, end_ns=START + 40 * MS)
        assert texts(some) == ["0/b40"]
        assert [time - START for time, _ in played.files()] == [0, 10 * MS]
        assert not played.has_sqlite
    finally:
        played.close()


def test_an_empty_bag_does_not_move_the_start(bags):
    paths = bags(TWO[0], [])
    played = PlayedBags(paths)
    assert (played.start_ns, played.end_ns) == (START, START + 40 * MS)
    played.close()
    with pytest.raises(FileNotFoundError, match="no bag at none"):
        PlayedBags([*paths, "none"])


@pytest.mark.parametrize(
    ("window", "expected"),
    [
        (0, ["0/a0", "0/a5", "0/b40", "0/a30", "0/a20"]),
        (1, ["0/a0", "0/a5", "0/a30", "0/a20", "0/b40"]),
        (10, ["0/a0", "0/a5", "0/a20", "0/a30", "0/b40"]),
    ],
)
def test_the_order_of_sending(bags, window, expected):
    late = [("/a", 1, 0), ("/a", 10, 5), ("/b", 42, 40), ("/a", 43, 30), ("/a", 44, 20)]
    played = PlayedBags(bags(late), window)
    messages = list(played.messages(["/a", "/b"]))
    assert texts(messages) == expected
    if window:
        assert all(each.log_time_ns == each.publish_time_ns for each in messages)
    played.close()


def test_sqlite_has_one_time(bags):
    played = PlayedBags(bags([("/a", 1, 0)], storage="sqlite3"), 10)
    assert played.has_sqlite
    assert [each.log_time_ns for each in played.messages(["/a"])] == [START + MS]
    played.close()


@pytest.mark.parametrize("order", MessageOrder)
def test_a_player_plays_several_bags(peer, bags, order):
    paths = bags([("/a", 0, 0), ("/a", 40, 15)], [("/a", 20, 20), ("/a", 50, 50)])
    heard = peer.listen("/a", DEEP)
    options = PlayOptions(disable_keyboard_controls=True, message_order=order)
    rosbag2_py.Player().play([StorageOptions(uri=path) for path in paths], options)
    peer.wait_for(lambda: len(heard) == 4)
    late = ["1/a20", "0/a15"]
    assert [each.data for each in heard] == [
        "0/a0",
        *(late if order == MessageOrder.RECEIVED_TIMESTAMP else late[::-1]),
        "1/a50",
    ]


def test_the_command(peer, bags, bag_verb):
    paths = bags(*TWO)
    heard = peer.listen("/a", DEEP)
    words = ("--disable-keyboard-controls", "--message-order", "sent")
    assert bag_verb("play", "-i", paths[0], "-i", paths[1], "mcap", *words).wait() == 0
    peer.wait_for(lambda: len(heard) == 2)
    assert bag_verb("play", paths[1], "--input", paths[0], *words).wait() == 0
    peer.wait_for(lambda: len(heard) == 4)
    assert [each.data for each in heard] == ["0/a0", "1/a10", "0/a0", "1/a10"]


def test_without_a_bag_it_says_so(capsys):
    for verb in ("play", "burst"):
        with pytest.raises(SystemExit):
            main(["bag", verb])
        assert "are required: bag_path, or -i/--input" in capsys.readouterr().err


def test_the_arguments_of_other_verbs(bags, tmp_path):
    paths = bags(*TWO)
    parser = argparse.ArgumentParser()
    api.add_multi_bag_input_arg(parser, required=True)
    given = parser.parse_args(["-i", paths[0], "-i", paths[1], "sqlite3"]).input
    options = api.input_bag_arg_to_storage_options(given, "file.yaml")
    assert [(each.uri, each.storage_id) for each in options] == [
        (paths[0], ""),
        (paths[1], "sqlite3"),
    ]
    assert {each.storage_config_uri for each in options} == {"file.yaml"}
    assert api.input_bag_arg_to_storage_options() == []
    for words, error in (
        ([str(tmp_path / "none")], "does not exist"),
        ([paths[0], "text"], "invalid storage 'text'"),
        ([paths[0], "mcap", "more"], "got 3 words"),
    ):
        with pytest.raises(ValueError, match=error):
            api.input_bag_arg_to_storage_options([words])
    with pytest.raises(SystemExit):
        parser.parse_args([])
    parser = argparse.ArgumentParser()
    api.add_standard_multi_reader_args(parser)
    args = parser.parse_args([paths[0], "-s", "mcap", "-i", paths[1]])
    assert [(each.uri, each.storage_id) for each in bags_to_play(args)] == [
        (paths[0], "mcap"),
        (paths[1], ""),
    ]


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
