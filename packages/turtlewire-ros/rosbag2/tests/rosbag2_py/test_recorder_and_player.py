"""Recorder, Player and bag_rewrite as scripts use them: in a thread, ended by `cancel`."""

import threading

import pytest
from tests.places import GOLDEN

import rosbag2_py
from std_msgs.msg import String

from ..rosbag2_transport.conftest import LATCHED, peer, texts  # noqa: F401 - a fixture

SMALL = GOLDEN / "bag" / "p_small"
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


def wait_for_node(peer, name, *, present=True):  # noqa: F811
    def is_so():
        return (name in peer.node.get_node_names()) is present

    assert peer.context.wire.graph.wait_for(is_so, 60 * SECOND)


def test_a_recorder_that_is_steered(peer, tmp_path):  # noqa: F811 - the fixture
    options = rosbag2_py.RecordOptions(topics=["/latched"], disable_keyboard_controls=True)
    recorder = rosbag2_py.Recorder(storage(tmp_path / "out"), options, "info", "own_recorder")
    recorder.start_spin()
    assert not recorder.is_paused()
    publisher = peer.publisher("/latched", LATCHED)
    recorder.record()
    peer.heard(publisher)
    wait_for_node(peer, "own_recorder")
    publisher.publish(String(data="first"))
    assert publisher.wait_for_all_acked()
    recorder.pause()
    assert recorder.is_paused()
    recorder.resume()
    publisher.publish(String(data="second"))
    assert publisher.wait_for_all_acked()
    recorder.stop()
    recorder.stop_spin()
    assert texts(tmp_path / "out", "/latched") == ["first", "second"]
    with pytest.raises(RuntimeError, match="nothing is recorded"):
        recorder.pause()
    with pytest.raises(RuntimeError, match="Bag directory already exists"):
        recorder.record()


def test_a_player_that_is_steered(peer):  # noqa: F811 - the fixture
    got = peer.listen("/b")
    options = rosbag2_py.PlayOptions(rate=50.0, start_paused=True, disable_keyboard_controls=True)
    player = rosbag2_py.Player([storage(SMALL)], options, node_name="own_player")
    player.start_spin()
    wait_for_node(peer, "own_player")
    assert player.get_starting_time() == 1_800_000_000 * SECOND
    assert player.get_playback_duration() > 2 * SECOND
    assert player.play()
    assert not player.play()
    assert player.wait_for_playback_to_start(60)
    assert player.is_paused()
    assert not player.wait_for_playback_to_finish(0)
    assert player.burst(0) > 7
    peer.wait_for(lambda: len(got) == 7)
    assert not player.play_next()
    player.seek(player.get_starting_time())
    assert player.play_next()
    player.resume()
    assert not player.is_paused()
    assert player.wait_for_playback_to_finish(60)
    peer.wait_for(lambda: len(got) == 14)
    player.pause()
    assert player.play()
    assert player.wait_for_playback_to_start_exclusively()
    player.stop()
    assert player.wait_for_playback_to_finish_exclusively()


def test_a_steered_player_ends_with_its_object(peer):  # noqa: F811 - the fixture
    player = rosbag2_py.Player(storage(SMALL), rosbag2_py.PlayOptions(start_paused=True))
    player.play()
    wait_for_node(peer, "rosbag2_player")
    del player
    wait_for_node(peer, "rosbag2_player", present=False)


def test_steering_without_a_bag_is_an_error(tmp_path):
    with pytest.raises(RuntimeError, match="there is no bag at nothing"):
        rosbag2_py.Player(storage("nothing"), rosbag2_py.PlayOptions())
    with pytest.raises(RuntimeError, match="expected at least one bag to play"):
        rosbag2_py.Player([], rosbag2_py.PlayOptions())
    with pytest.raises(RuntimeError, match="this Player has no bag"):
        rosbag2_py.Player().pause()
    with pytest.raises(RuntimeError, match="this Recorder has no bag"):
        rosbag2_py.Recorder("debug").record()
    options = rosbag2_py.RecordOptions(topics=["/a b"])
    with pytest.raises(RuntimeError, match="'/a b' cannot be the name of a topic"):
        rosbag2_py.Recorder(storage(tmp_path / "x"), options).record()


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


EVERY_KEY = """
output_bags:
- uri: {folder}/every
  storage_id: sqlite3
  max_bagfile_size: 0
  max_bagfile_duration: 1
  max_cache_size: 100
  storage_preset_profile: resilient
  storage_config_uri: ''
  snapshot_mode: false
  start_time_ns: -1
  end_time_ns: -1
  custom_data: {{a: b}}
  all: false
  all_topics: false
  all_services: true
  topics: /a
  topic_types: [tf2_msgs/msg/TFMessage]
  services: []
  regex: ''
  exclude_regex: ''
  exclude_topics: [/lossy]
  exclude_topic_types: []
  exclude_services: []
  rmw_serialization_format: cdr
  topic_polling_interval: {{sec: 0, nsec: 10000000}}
  node_prefix: ''
  compression_mode: message
  compression_format: zstd
  compression_queue_size: 1
  compression_threads: 0
  topic_qos_profile_overrides: {{/a: {{depth: 3}}}}
  include_hidden_topics: true
  include_unpublished_topics: true
  is_discovery_disabled: false
- uri: {folder}/nothing
- uri: {folder}/wrong
  topics: [/aa]
"""


def test_rewrite_knows_every_key_and_joins_bags(tmp_path, capfd):
    (tmp_path / "out.yaml").write_text(EVERY_KEY.format(folder=tmp_path))
    rosbag2_py.bag_rewrite(
        [storage(SMALL), storage(SMALL, storage_id="mcap")], str(tmp_path / "out.yaml")
    )
    metadata = rosbag2_py.Info().read_metadata(str(tmp_path / "every"), "")
    assert [item.topic_metadata.name for item in metadata.topics_with_message_count] == [
        "/a",
        "/tf_static",
    ]
    assert (metadata.compression_mode, metadata.custom_data) == ("MESSAGE", {"a": "b"})
    assert len(metadata.files) > 1
    assert texts(tmp_path / "every", "/a") == [text for text in texts(SMALL, "/a") for _ in "ab"]
    told = capfd.readouterr().err
    assert told.count(f"Nothing is written to {tmp_path}/nothing: choose by all, all_topics") == 1
    assert told.count("Nothing of /aa is written to") == 1
    assert (tmp_path / "wrong" / "metadata.yaml").exists()


def test_a_rewrite_whose_second_bag_exists_leaves_no_empty_first_one(tmp_path):
    (tmp_path / "second").mkdir()
    (tmp_path / "out.yaml").write_text(
        f"output_bags:\n- uri: {tmp_path}/first\n- uri: {tmp_path}/second\n"
    )
    with pytest.raises(RuntimeError, match="Bag directory already exists"):
        rosbag2_py.bag_rewrite([storage(SMALL)], str(tmp_path / "out.yaml"))
    assert not (tmp_path / "first").exists()
