"""Programs as ROS 2's tutorials and users write them with rosbag2_py."""

import datetime as dt
import threading

import pytest

import rosbag2_py
from rclpy.clock import Clock
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Int32, String

from ..rosbag2_transport.conftest import peer, texts  # noqa: F401 - a fixture


class Recorder(Node):
    """Records what arrives on a topic, from its callback."""

    def __init__(self, uri, context):
        super().__init__("simple_bag_recorder", context=context)
        self.writer = rosbag2_py.SequentialWriter()
        storage_options = rosbag2_py._storage.StorageOptions(uri=uri, storage_id="mcap")
        converter_options = rosbag2_py._storage.ConverterOptions("", "")
        self.writer.open(storage_options, converter_options)
        topic_info = rosbag2_py._storage.TopicMetadata(
            id=0, name="chatter", type="std_msgs/msg/String", serialization_format="cdr"
        )
        self.writer.create_topic(topic_info)
        self.arrived = threading.Event()
        self.create_subscription(String, "chatter", self.topic_callback, 10)

    def topic_callback(self, msg):
        stamp = self.get_clock().now().nanoseconds
        self.writer.write("chatter", serialize_message(msg), stamp)
        self.arrived.set()


class Playback(Node):
    """Publishes the bytes of a bag as they are, one message at a call."""

    def __init__(self, uri, context):
        super().__init__("playback_node", context=context)
        self.reader = rosbag2_py.SequentialReader()
        storage_options = rosbag2_py._storage.StorageOptions(uri=uri, storage_id="mcap")
        converter_options = rosbag2_py._storage.ConverterOptions(
            input_serialization_format="cdr", output_serialization_format="cdr"
        )
        self.reader.open(storage_options, converter_options)
        self.publisher = self.create_publisher(String, "again", 10)

    def timer_callback(self):
        while self.reader.has_next():
            msg = self.reader.read_next()
            if msg[0] == "chatter":
                self.publisher.publish(msg[1])
                break


def test_recording_and_reading_in_nodes(peer, tmp_path):  # noqa: F811 - the fixture
    uri = str(tmp_path / "my_bag")
    recorder = Recorder(uri, peer.context)
    peer._executor.add_node(recorder)
    peer.heard(peer.publisher("/chatter")).publish(String(data="hello"))
    assert recorder.arrived.wait(60)
    recorder.writer.close()
    got = peer.listen("/again")
    player = Playback(uri, peer.context)
    peer.heard(player.publisher)
    player.timer_callback()
    peer.wait_for(lambda: got)
    assert got[0].data == "hello"
    for node in (recorder, player):
        node.destroy_node()


def test_synthetic_data_from_an_executable(tmp_path):
    writer = rosbag2_py.SequentialWriter()
    writer.open(
        rosbag2_py.StorageOptions(uri=str(tmp_path / "big_synthetic_bag"), storage_id="sqlite3"),
        rosbag2_py.ConverterOptions("", ""),
    )
    writer.create_topic(
        rosbag2_py.TopicMetadata(
            id=0, name="synthetic", type="std_msgs/msg/Int32", serialization_format="cdr"
        )
    )
    time_stamp = Clock().now()
    for i in range(100):
        writer.write("synthetic", serialize_message(Int32(data=i)), time_stamp.nanoseconds)
        time_stamp += Duration(seconds=1)
    writer.close()
    info = rosbag2_py.Info().read_metadata(str(tmp_path / "big_synthetic_bag"), "sqlite3")
    assert (info.message_count, info.duration) == (100, Duration(seconds=99))


def test_a_bag_is_filtered_into_another_with_compression(tmp_path):
    source, target = str(tmp_path / "source"), str(tmp_path / "target")
    topics = [
        rosbag2_py.TopicMetadata(0, name, "std_msgs/msg/String", "cdr") for name in ("/a", "/b")
    ]
    writer = rosbag2_py.SequentialWriter()
    writer.open(rosbag2_py.StorageOptions(source), rosbag2_py.ConverterOptions())
    for topic in topics:
        writer.create_topic(topic)
        for i in range(3):
            writer.write(topic.name, serialize_message(String(data=f"{topic.name} {i}")), i, i)
    del writer
    reader = rosbag2_py.SequentialReader()
    reader.open_uri(source)
    reader.set_filter(rosbag2_py.StorageFilter(topics=["/b"]))
    compression = rosbag2_py.CompressionOptions(
        "zstd", rosbag2_py.CompressionMode.FILE, compression_queue_size=1, compression_threads=1
    )
    compressed = rosbag2_py.SequentialCompressionWriter(compression)
    compressed.open(rosbag2_py.StorageOptions(target), rosbag2_py.ConverterOptions("cdr", "cdr"))
    types = {topic.name: topic for topic in reader.get_all_topics_and_types()}
    compressed.create_topic(types["/b"])
    while reader.has_next():
        compressed.write(*reader.read_next())
    compressed.close()
    again = rosbag2_py.SequentialCompressionReader()
    again.open(rosbag2_py.StorageOptions(target, "mcap"), rosbag2_py.ConverterOptions())
    assert again.get_metadata().compression_mode == "FILE"
    found = []
    while again.has_next():
        name, data, stamp = again.read_next()
        found.append((name, deserialize_message(data, String).data, stamp))
    assert found == [("/b", f"/b {i}", i) for i in range(3)]


def test_a_recorder_with_options_as_attributes(peer, tmp_path):  # noqa: F811 - the fixture
    from rosbag2_py._transport import Recorder, RecordOptions

    options = RecordOptions()
    options.all_topics = True
    options.is_discovery_disabled = False
    options.topic_polling_interval = dt.timedelta(milliseconds=10)
    options.topic_qos_profile_overrides = {"/chatter": QoSProfile(depth=10)}
    assert options.topic_qos_profile_overrides == {"/chatter": QoSProfile(depth=10)}
    recorder = Recorder("info")
    storage = rosbag2_py.StorageOptions(uri=str(tmp_path / "bag"))
    publisher = peer.publisher("/chatter")
    thread = threading.Thread(target=recorder.record, args=(storage, options), daemon=True)
    thread.start()
    peer.heard(publisher).publish(String(data="hello"))
    assert publisher.wait_for_all_acked()
    recorder.cancel()
    thread.join(60)
    assert not thread.is_alive()
    assert texts(tmp_path / "bag", "/chatter") == ["hello"]


@pytest.mark.parametrize(
    "make",
    [
        lambda: rosbag2_py.StorageOptions(uri="bag"),
        rosbag2_py.ConverterOptions,
        rosbag2_py.StorageFilter,
        rosbag2_py.ReadOrder,
        rosbag2_py.CompressionOptions,
        rosbag2_py.RecordOptions,
        rosbag2_py.PlayOptions,
        rosbag2_py.BagMetadata,
        lambda: rosbag2_py.TopicMetadata(0, "/a", "t", "cdr"),
    ],
)
def test_a_misspelt_attribute_is_refused(make):
    with pytest.raises(AttributeError, match="al_topics"):
        make().al_topics = True


def test_enums():
    assert int(rosbag2_py.CompressionMode.FILE) == 1
    assert rosbag2_py.CompressionMode(2) is rosbag2_py.CompressionMode.MESSAGE
    assert [mode.name for mode in rosbag2_py.ReadOrderSortBy] == [
        "ReceivedTimestamp",
        "PublishedTimestamp",
        "File",
    ]
    assert rosbag2_py.compression_mode_to_string(rosbag2_py.CompressionMode.FILE) == "FILE"
    assert rosbag2_py.compression_mode_from_string("") is rosbag2_py.CompressionMode.NONE
    with pytest.raises(RuntimeError, match='CompressionMode "rocket" is not valid'):
        rosbag2_py.compression_mode_from_string("rocket")
    for make in (rosbag2_py.Recorder, rosbag2_py.Player):
        with pytest.raises(RuntimeError):
            make("rocket")
