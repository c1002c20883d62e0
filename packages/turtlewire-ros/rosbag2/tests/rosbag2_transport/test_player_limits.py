"""Where a playback ends, and where its clock stands after each command."""

from __future__ import annotations

import threading

import pytest

from rosbag2_py import PlayOptions
from rosbag2_transport.player import Player
from std_msgs.msg import String
from turtlewire.bag import BagWriter

SECOND = 1_000_000_000
START = 1_800_000_000 * SECOND
TIMES = [START, START + 10, START + 20, START + 30]


@pytest.fixture
def player(peer, tmp_path):
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/text", "std_msgs/msg/String")
        for time in TIMES:
            writer.write("/text", String(data=str(time - START)), time)
    players = []

    def make(**options):
        made = Player(peer.node, str(tmp_path / "bag"), PlayOptions(**options))
        made.sent = []
        made.on_publish.append(lambda message: made.sent.append(message.log_time_ns - START))
        players.append(made)
        return made

    yield make
    for made in players:
        made.close()


@pytest.mark.parametrize(
    ("until", "sent"),
    [(0, [0]), (9, [0]), (10, [0, 10]), (29, [0, 10, 20]), (30, [0, 10, 20, 30])],
)
def test_a_message_at_the_last_moment_is_played(player, until, sent):
    bounded = player(playback_until_timestamp=START + until)
    bounded.play()
    assert bounded.sent == sent
    assert bounded.end_ns == START + until


@pytest.mark.parametrize(("offset_ns", "sent"), [(10, [10, 20, 30]), (11, [20, 30])])
def test_a_message_at_the_offset_is_played(player, offset_ns, sent):
    late = player(start_offset=offset_ns / SECOND)
    late.play()
    assert late.sent == sent


def test_the_clock_stands_at_the_message_that_was_played_last(player, start):
    paused = player(start_paused=True)
    start(paused.play)
    for count in range(1, 5):
        assert paused.play_next()
        assert paused.clock.now_ns() == TIMES[count - 1]
        assert paused.sent == [0, 10, 20, 30][:count]
    assert not paused.play_next()
    assert paused.clock.now_ns() == TIMES[-1]
    paused.seek(START + 10)
    assert paused.clock.now_ns() == START + 10
    assert paused.burst(2) == 2
    assert (paused.sent[4:], paused.clock.now_ns()) == ([10, 20], START + 20)
    assert paused.burst(0) == 1
    assert paused.burst(0) == 0
    paused.stop()


@pytest.fixture
def start():
    """Run a call on a thread that the test's end waits for."""
    threads = []

    def begin(call):
        threads.append(threading.Thread(target=call))
        threads[-1].start()

    yield begin
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive()
