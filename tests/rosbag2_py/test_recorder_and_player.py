"""Recorder, Player and bag_rewrite as scripts use them: in a thread, ended by `cancel`."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
from tests.rosbag2_transport.conftest import LATCHED, peer, texts  # noqa: F401 - a fixture

import rosbag2_py
from std_msgs.msg import String

SMALL = Path(__file__).parents[1] / "golden" / "bag" / "p_small"
SECOND = 1_000_000_000


def storage(path, **options):
    return rosbag2_py.StorageOptions(uri=str(path), **options)


def test_a_recorder_in_a_thread(peer, tmp_path):  # noqa: F811 - the fixture
    recorder = rosbag2_py.Recorder()
    options = rosbag2_py.RecordOptions(topics=["/latched"], disable_keyboard_controls=True)
    thread = threading.Thread(target=recorder.record, args=(storage(tmp_path / "out"), options))
    publisher = peer.publisher("/latched", LATCHED)
    publisher.publish(String(data="hello"))
    thread.start()
    peer.heard(publisher)
    assert publisher.wait_for_all_acked()
    recorder.cancel()
    thread.join(60)
    assert not thread.is_alive()
    assert texts(tmp_path / "out", "/latched") == ["hello"]


def test_a_player_plays_to_the_end_and_can_be_cancelled(peer):  # noqa: F811 - the fixture
    got = peer.listen("/b")
    player = rosbag2_py.Player()
    options = rosbag2_py.PlayOptions(rate=50.0, disable_keyboard_controls=True)
    player.play(storage(SMALL), options)
    peer.wait_for(lambda: len(got) == 7)
    options.start_paused = True
    thread = threading.Thread(target=player.burst, args=(storage(SMALL), options, 0))
    thread.start()
    peer.wait_for(lambda: len(got) == 14)
    player.cancel()
    thread.join(60)
    assert not thread.is_alive()


def test_a_bag_that_is_not_there():
    with pytest.raises(RuntimeError, match="there is no bag at nothing"):
        rosbag2_py.Player().play(storage("nothing"), rosbag2_py.PlayOptions())


def test_rewrite_chooses_topics_and_times(tmp_path):
    start = 1_800_000_000 * SECOND
    (tmp_path / "out.yaml").write_text(
        f"output_bags:\n- uri: {tmp_path}/part\n  regex: /(a|latched)$\n  exclude: lat\n"
        f"  start_time_ns: {start + SECOND}\n  end_time_ns: {start + 2 * SECOND}\n"
        f"- uri: {tmp_path}/whole\n  storage_id: sqlite3\n  all: true\n"
    )
    rosbag2_py.bag_rewrite([storage(SMALL)], str(tmp_path / "out.yaml"))
    every = texts(SMALL, "/a")
    part = texts(tmp_path / "part", "/a")
    assert part == [text for text in every if text in part]
    assert 0 < len(part) < len(every)
    assert texts(tmp_path / "part", "/latched") == []
    assert texts(tmp_path / "whole", "/a") == every
    assert texts(tmp_path / "whole", "/latched") == texts(SMALL, "/latched")
