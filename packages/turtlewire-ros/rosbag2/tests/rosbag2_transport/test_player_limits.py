"""The end of a playback, and the time of its clock after each command."""

import threading
from types import SimpleNamespace

import pytest

from rosbag2_py import PlayOptions
from rosbag2_transport.player import BagPlayer
from rosbag2_transport.player_services import PlayerServices
from std_msgs.msg import String
from turtlewire.bag import BagWriter
from turtlewire.errors import BagError

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
        made = BagPlayer(peer.node, [str(tmp_path / "bag")], PlayOptions(**options))
        made.sent = []
        made.on_publish.append(lambda message: made.sent.append(message.log_time_ns - START))
        players.append(made)
        return made

    yield make
    for made in players:
        made.close()


@pytest.mark.parametrize(
    ("until", "sent"), [(0, [0]), (9, [0]), (10, [0, 10]), (29, [0, 10, 20]), (30, [0, 10, 20, 30])]
)
def test_a_message_at_the_last_moment_is_played(player, until, sent):
    bounded = player(playback_until_timestamp=START + until)
    bounded.play()
    assert bounded.sent == sent
    assert bounded.end_ns == START + until


@pytest.mark.parametrize(
    ("offset_ns", "sent"), [(10, [10, 20, 30]), (11, [20, 30]), (30, [30]), (31, [])]
)
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


def test_a_playback_that_failed_can_be_played_again(player, monkeypatch, start):
    steered = player(start_paused=True)
    failures = []

    def play():
        with pytest.raises(BagError) as error:
            steered.play()
        failures.append(str(error.value))

    def damaged(*_args, **_options):
        raise BagError("a chunk is damaged")

    start(play)
    assert steered.wait_until_started(60)
    with monkeypatch.context() as patch:
        patch.setattr(steered._bag, "messages", damaged)
        steered.seek(START + 10)
    with steered.changed:
        assert steered.changed.wait_for(lambda: not steered._playing, 60)
    steered.resume()
    steered.play()
    assert steered.sent == [0, 10, 20, 30]
    assert failures == ["a chunk is damaged"]


def test_a_second_playback_has_not_started_because_the_first_one_had(player):
    twice = player()
    twice.play()
    assert twice.wait_until_started(0)
    assert twice.begin()
    assert not twice.wait_until_started(0)
    twice.run()
    assert twice.wait_until_started(0)
    assert twice.sent == [0, 10, 20, 30] * 2


def test_the_first_message_of_a_file_announces_the_file_in_each_round(peer, tmp_path):
    with BagWriter(tmp_path / "bag", max_file_ns=10) as writer:
        writer.add_topic("/text", "std_msgs/msg/String")
        for time in (START, START + 10, START + 21):
            writer.write("/text", String(), time)
    player, splits = BagPlayer(peer.node, [str(tmp_path / "bag")], PlayOptions()), []
    PlayerServices(peer.node, player)._splits = SimpleNamespace(publish=splits.append)
    for count in (1, 2):
        player.play()
        assert [split.opened_file for split in splits] == [
            str(tmp_path / "bag" / "bag_1.mcap")
        ] * count
    player.close()


@pytest.mark.parametrize(("delay", "logged"), [(0.0, False), (1e-9, True)])
def test_only_a_delay_is_logged(player, capfd, delay, logged):
    player(delay=delay).play()
    assert ("Sleep" in capfd.readouterr().err) is logged
