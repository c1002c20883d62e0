"""`ros2 bag record`: published messages are in the bag, whatever happens to the recorder."""

import random
import re
import signal
import sys
import threading

import pytest
from tests.needs import needs_cyclone_dds

from rclpy.context import Context
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rosbag2_interfaces import srv
from rosbag2_interfaces.msg import WriteSplitEvent
from rosbag2_transport.options import RecordOptions
from rosbag2_transport.recorder import BagRecorder
from std_msgs.msg import String
from turtlewire.bag import open_bag, reindex
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

from .conftest import DEEP, LATCHED, ROS2, end, texts, wait_until_written

NAMES = [f"number {i}" for i in range(500)]
SIZE_LIMIT = 3_000_000
LIMITED = (
    "import os, resource, sys; "
    f"resource.setrlimit(resource.RLIMIT_FSIZE, ({SIZE_LIMIT}, {SIZE_LIMIT})); "
    "os.execv(sys.argv[1], sys.argv[1:])"
)


def publish(publisher, names=NAMES):
    for name in names:
        publisher.publish(String(data=name))


#: Ctrl-C, and what comes when the terminal is closed; on Windows there is only the first.
HANGUP = getattr(signal, "SIGHUP", signal.SIGINT)


@pytest.mark.parametrize(("storage", "ended_by"), [("mcap", signal.SIGINT), ("sqlite3", HANGUP)])
def test_everything_is_recorded_in_order(peer, bag_verb, tmp_path, storage, ended_by):
    publisher = peer.publisher("/numbers")
    latched = peer.publisher("/latched", LATCHED)
    publish(latched, ["before the recorder"])
    recorder = bag_verb("record", "-o", "out", "-s", storage, "--topics", "/numbers", "/latched")
    recorder.wait_for("All requested topics are subscribed. Stopping discovery...")
    publish(peer.heard(publisher))
    wait_until_written(tmp_path / "out", "/numbers", len(NAMES))
    recorder.signal_group(ended_by)
    assert recorder.wait() == 0
    assert texts(tmp_path / "out", "/numbers") == NAMES
    assert texts(tmp_path / "out", "/latched") == ["before the recorder"]
    with open_bag(tmp_path / "out") as bag:
        assert [qos.depth for qos in bag.topics["/numbers"].qos] == [DEEP.depth]
        first = next(bag.messages("/latched"))
        assert first.publish_time_ns <= first.log_time_ns
    for line in ("Pausing recording.", "Recording stopped", "Press SPACE for pausing/resuming"):
        assert recorder.text.count(line) == 1


def test_after_kill_9_at_any_moment_reindex_makes_a_bag(peer, bag_verb, tmp_path):
    publisher = peer.publisher("/numbers")
    storages = ("mcap", "sqlite3")
    recorders = [
        bag_verb(
            *("record", "-o", storage, "-s", storage, "-b", "90000", "--topics", "/numbers"),
            *("--disable-keyboard-controls", "--node-name", f"recorder_{storage}"),
        )
        for storage in storages
    ]
    peer.heard(publisher, by=2)
    ended = threading.Event()
    stream = threading.Thread(target=count_until, args=(publisher, ended))
    stream.start()
    try:
        for storage, recorder in zip(storages, recorders, strict=True):
            moment = random.randrange(1, 1000)
            wait_until_written(tmp_path / storage, "/numbers", moment)
            before = texts(tmp_path / storage, "/numbers")
            recorder.signal_group(signal.SIGKILL)
            recorder.wait()
            assert not (tmp_path / storage / "metadata.yaml").exists()
            reindex(tmp_path / storage)
            assert (tmp_path / storage / "metadata.yaml").exists()
            found = texts(tmp_path / storage, "/numbers")
            assert found[: len(before)] == before
            first = int(before[0].split()[0])
            assert [int(text.split()[0]) for text in found] == [
                first + i for i in range(len(found))
            ]
    finally:
        ended.set()
        stream.join()


def count_until(publisher, ended):
    """Publish a thousand messages of different sizes in a second."""
    number = 0
    while not ended.wait(0.001):
        publish(publisher, [f"{number} {'x' * (number % 7 * 50)}"])
        number += 1


@pytest.mark.skipif(sys.platform == "win32", reason="there a file's size cannot be limited")
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_full_disk_ends_the_recording_with_one_line(peer, run, tmp_path, storage):
    publisher = peer.publisher("/numbers")
    recorder = run(
        *(sys.executable, "-c", LIMITED, ROS2, "bag", "record", "-o", "out", "-s", storage, "-a"),
        cwd=tmp_path,
    )
    recorder.wait_for("Subscribed to topic '/numbers'")
    peer.heard(publisher)
    names = []
    while recorder.process.poll() is None and len(names) < 100_000:
        names.append(f"{len(names)} {'x' * 10_000}")
        publish(publisher, names[-1:])
        wait_a_little.wait(0.005)
    assert recorder.wait() == 1
    lines = [line for line in recorder.text.splitlines() if "Recording stopped: " in line]
    assert len(lines) == 1
    assert "Traceback" not in recorder.text
    found = texts(tmp_path / "out", "/numbers")
    assert 0 < len(found) < len(names)
    assert names[: len(found)] == found


wait_a_little = threading.Event()


@needs_cyclone_dds  # Zenoh does not tell what was received before the pause
def test_latched_messages_that_come_during_a_pause_are_kept(peer, bag_verb, tmp_path):
    publisher, latched = peer.publisher("/numbers"), peer.publisher("/latched", LATCHED)
    recorder = bag_verb("record", "-o", "out", "-a", "--start-paused")
    recorder.wait_for("Wait for recording: Press SPACE to start.")
    recorder.wait_for("Subscribed to topic '/latched'")
    name = "/rosbag2_recorder"
    assert peer.call(srv.IsPaused, f"{name}/is_paused").paused
    publish(peer.heard(publisher), ["lost"])
    publish(peer.heard(latched), ["kept"])
    assert publisher.wait_for_all_acked()
    peer.call(srv.Resume, f"{name}/resume")
    assert not peer.call(srv.IsPaused, f"{name}/is_paused").paused
    publish(publisher, NAMES)
    assert publisher.wait_for_all_acked()
    peer.call(srv.Pause, f"{name}/pause")  # what came before is recorded
    publish(publisher, ["lost, too"])
    assert end(recorder) == 0
    assert texts(tmp_path / "out", "/numbers") == NAMES
    assert texts(tmp_path / "out", "/latched") == ["kept"]
    assert recorder.text.count("Resuming recording.") == 1


class KeptRecording:
    """A recording in memory."""

    def __init__(self):
        self.data = []

    def add_topic(self, *_args, **_options):
        pass

    def write(self, _topic, data, _received_ns, _sent_ns):
        self.data.append(data)


@pytest.mark.parametrize("count", [999, 1000, 1001, 2500])
def test_all_that_has_arrived_before_a_pause_is_recorded(monkeypatch, count):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with Context() as context:
        node, recording = Node("recorder", context=context), KeptRecording()
        recorder = BagRecorder(node, recording, RecordOptions(topics=["/many"]))
        publisher = node.create_publisher(String, "many", DEEP)
        recorder._subscribe_to_new()  # and no thread takes messages
        for number in range(count):
            publisher.publish(String(data=str(number)))
        recorder.pause()
        publisher.publish(String(data="during the pause"))
        recorder.resume()
        found = [deserialize_message(data, String).data for data in recording.data]
        assert found == [str(number) for number in range(count)]
        node.destroy_node()


def test_split_files_are_reported(peer, bag_verb, tmp_path):
    publisher = peer.publisher("/numbers")
    splits = peer.listen("/events/write_split", type_=WriteSplitEvent)
    recorder = bag_verb("record", "-o", "out", "-b", "20000", "--topics", "/numbers")
    recorder.wait_for("Subscribed to topic '/numbers'")
    publish(peer.heard(publisher))
    wait_until_written(tmp_path / "out", "/numbers", len(NAMES))
    peer.wait_for(lambda: splits)
    peer.call(srv.SplitBagfile, "/rosbag2_recorder/split_bagfile")
    assert end(recorder) == 0
    assert texts(tmp_path / "out", "/numbers") == NAMES
    assert splits[0].closed_file == str(tmp_path / "out" / "out_0.mcap")
    assert splits[0].opened_file == str(tmp_path / "out" / "out_1.mcap")
    assert splits[0].node_name == "/rosbag2_recorder"
    with open_bag(tmp_path / "out") as bag:
        assert len(bag.metadata.paths) >= 3


def test_snapshots_hold_the_newest_messages(peer, bag_verb, tmp_path):
    publisher = peer.publisher("/numbers")
    received = peer.listen("/numbers")
    recorder = bag_verb(
        *("record", "-o", "out", "--topics", "/numbers", "--snapshot-mode"),
        *("--max-cache-size", "2000"),
    )
    recorder.wait_for("Subscribed to topic '/numbers'")
    publish(peer.heard(publisher, by=2))
    peer.wait_for(lambda: len(received) == len(NAMES))
    for _ in range(600):  # the recorder may take them later than this process
        assert peer.call(srv.Snapshot, "/rosbag2_recorder/snapshot").success
        if NAMES[-1] in texts(tmp_path / "out", "/numbers"):
            break
    assert end(recorder) == 0
    found = texts(tmp_path / "out", "/numbers")
    assert found[-1] == NAMES[-1]
    assert found == [name for name in NAMES if name in found]


@needs_cyclone_dds  # Zenoh drops what a subscription does not take in time
def test_losses_of_a_full_cache_are_counted(peer, bag_verb, tmp_path):
    publisher = peer.publisher("/numbers")
    options = ("--disable-keyboard-controls", "--max-cache-size", "1", "--topics", "/numbers")
    recorder = bag_verb("record", "-o", "out", *options)
    recorder.wait_for("Subscribed to topic '/numbers'")
    publish(peer.heard(publisher))
    assert publisher.wait_for_all_acked()
    assert end(recorder) == 0
    recorder.wait_for("Cache buffers lost messages per topic:")
    lost = int(recorder.wait_for(r"Total lost: (\d+)")[0][1])
    recorder.wait_for(f"/numbers: {lost}")
    found = texts(tmp_path / "out", "/numbers")
    assert found[0] == NAMES[0]
    assert 0 < lost == len(NAMES) - len(found)


def test_two_interrupts_at_bad_moments_do_not_spoil_the_bag(peer, bag_verb, tmp_path):
    publisher = peer.publisher("/numbers")
    moments = ("Event publisher thread: Starting", "Listening for topics", "Subscribed to topic")
    recorders = [
        bag_verb(
            "record", "-o", f"out_{number}", "--topics", "/numbers", "--node-name", f"r{number}"
        )
        for number in range(len(moments))
    ]
    publish(publisher)
    for number, (recorder, moment) in enumerate(zip(recorders, moments, strict=True)):
        recorder.wait_for(moment)
        recorder.signal_group(signal.SIGINT)
        recorder.signal_group(signal.SIGINT)
        # The second one may come when the bag is finished, and nothing handles it any more.
        assert recorder.wait() in (0, 2, -signal.SIGINT)
        assert "Traceback" not in recorder.text
        assert (tmp_path / f"out_{number}" / "metadata.yaml").exists()


def test_space_pauses_and_resumes(peer, bag_verb):
    recorder = bag_verb("record", "-o", "out", "-a", terminal=True)
    recorder.wait_for("Recording...")
    recorder.type(" ")
    recorder.wait_for("Pausing recording.")
    recorder.type(" ")
    recorder.wait_for("Resuming recording.")
    recorder.type("\x03")
    assert recorder.wait() == 0
    assert "Keyboard handling disabled" not in recorder.text


def test_topics_of_two_types_are_named_once(peer, bag_verb, tmp_path):
    from std_msgs.msg import Int32

    peer.publisher("/two")
    peer.node.create_publisher(Int32, "/two", DEEP)
    publisher = peer.publisher("/numbers")
    recorder = bag_verb("record", "-o", "out", "-a", "--disable-keyboard-controls")
    recorder.wait_for("Topic '/two' has several types associated")
    publish(peer.heard(publisher))
    wait_until_written(tmp_path / "out", "/numbers", len(NAMES))
    assert end(recorder) == 0
    assert recorder.text.count("several types") == 1
    with open_bag(tmp_path / "out") as bag:
        assert "/two" not in bag.topics


def test_a_topic_of_a_type_that_is_not_known_here_is_recorded(peer, bag_verb, tmp_path):
    type_id = TypeId("nobody_msgs/msg/Thing", "RIHS01_" + "7" * 64)
    publisher = peer.node._rclpy_wire.create_publisher("/thing", type_id, QoS())
    recorder = bag_verb("record", "-o", "out", "--topics", "/thing")
    recorder.wait_for("Subscribed to topic '/thing'")
    graph = peer.context.wire.graph
    assert graph.wait_for(lambda: publisher.subscription_count() > 0, 60_000_000_000)
    data = b"\x00\x01\x00\x00" + b"anything"
    publisher.publish(data)
    assert publisher.wait_for_acknowledgments(60_000_000_000)
    assert end(recorder) == 0
    with open_bag(tmp_path / "out") as bag:
        topic = bag.topics["/thing"]
        assert (topic.type, topic.type_hash) == (type_id.name, type_id.type_hash)
        assert [message.data for message in bag.messages("/thing")] == [data]


def test_a_topic_whose_type_has_no_name_of_ros_does_not_end_the_search(peer, bag_verb, tmp_path):
    """Also programs that are no nodes publish on DDS, and may give their types any name."""
    wire = peer.node._rclpy_wire
    wire.create_publisher("/odd", TypeId("Reading\x1b[2J", "RIHS01_" + "7" * 64), QoS())
    recorder = bag_verb("record", "-o", "out", "-a", "--disable-keyboard-controls")
    text = "Topic '/odd' cannot be recorded: 'Reading\\x1b[2J' is not the name of a message type"
    recorder.wait_for(re.escape(text))
    publish(peer.heard(peer.publisher("/later")))
    wait_until_written(tmp_path / "out", "/later", len(NAMES))
    assert end(recorder) == 0
    assert recorder.text.count("/odd") == 1
    assert "Traceback" not in recorder.text
    with open_bag(tmp_path / "out") as bag:
        assert "/odd" not in bag.topics
