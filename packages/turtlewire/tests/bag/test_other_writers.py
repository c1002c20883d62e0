"""Bags that other libraries write are read right, and their transforms end up in a buffer."""

from __future__ import annotations

import pytest
from mcap.writer import CompressionType, IndexType, Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.typesys import Stores, get_typestore
from tests.bags import START, transform

from turtlewire import Buffer, msg
from turtlewire.bag import open_bag
from turtlewire.wire.qos import Durability, Reliability

TF = "tf2_msgs/msg/TFMessage"
TEXT = "std_msgs/msg/String"


def rows():
    """Topic, type, log time and bytes."""
    text = msg.get_message(TEXT)
    for i in range(100):
        yield "/tf", TF, START + i * 10_000_000, msg.serialize(transform(i))
        if i % 10 == 0:
            yield "/chatter", TEXT, START + i * 10_000_000 + 1, msg.serialize(text(data=f"{i}"))


def check(path):
    expected = [(topic, kind, time, data) for topic, kind, time, data in rows()]
    with open_bag(path) as bag:
        assert [(m.topic, m.type, m.log_time_ns, m.data) for m in bag] == expected
        assert bag.problems == []
        assert (bag.start_ns, bag.end_ns) == (START, START + 990_000_000)
        assert {name: topic.message_count for name, topic in bag.topics.items()} == {
            "/tf": 100,
            "/chatter": 10,
        }
        found = bag.metadata
    buffer = Buffer.from_bag(path)
    assert buffer.bag_report.messages == 100
    assert buffer.lookup_transform("odom", "base_link", START + 505_000_000).x == pytest.approx(
        0.505
    )
    return found


@pytest.mark.parametrize("version", [8, 9])
@pytest.mark.parametrize("plugin", StoragePlugin)
@pytest.mark.parametrize("mode", CompressionMode)
def test_rosbags(tmp_path, version, plugin, mode):
    if plugin == StoragePlugin.SQLITE3 and mode == CompressionMode.STORAGE:
        pytest.skip("only MCAP files are compressed by their storage")
    store = get_typestore(Stores.ROS2_JAZZY)
    writer = RosbagsWriter(tmp_path / "made", version=version, storage_plugin=plugin)
    if mode != CompressionMode.NONE:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    writer.set_custom_data("robot", "r: 1")
    with writer:
        connections = {
            topic: writer.add_connection(topic, kind, typestore=store)
            for topic, kind in (("/tf", TF), ("/chatter", TEXT))
        }
        for topic, _, time, data in rows():
            writer.write(connections[topic], time, data)
    found = check(tmp_path / "made")
    assert found.version == version
    assert found.custom_data == {"robot": "r: 1"}
    assert found.storage == plugin.name.lower()
    assert found.compression_mode == ("" if mode.name in ("NONE", "STORAGE") else mode.name)


@pytest.mark.parametrize("compression", CompressionType)
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"chunk_size": 2000},
        {"use_chunking": False},
        {"index_types": IndexType.NONE, "chunk_size": 2000},
        {"use_statistics": False, "use_summary_offsets": False, "repeat_channels": False},
        {"enable_crcs": False},
    ],
    ids=lambda options: "-".join(options) or "default",
)
def test_mcap(tmp_path, compression, options):
    path = tmp_path / "made.mcap"
    with path.open("wb") as file:
        writer = Writer(file, compression=compression, **options)
        writer.start("ros2", "somebody")
        channels = {}
        for topic, kind in (("/tf", TF), ("/chatter", TEXT)):
            schema = writer.register_schema(kind, "ros2msg", b"")
            channels[topic] = writer.register_channel(topic, "cdr", schema)
        for topic, _, time, data in rows():
            writer.add_message(channels[topic], time, data, time - 5)
        writer.finish()
    check(path)
    with open_bag(path) as bag:
        assert next(iter(bag)).publish_time_ns == START - 5


def test_qos_that_rosbags_writes(tmp_path):
    from rosbags.interfaces import (
        Qos,
        QosDurability,
        QosHistory,
        QosLiveliness,
        QosReliability,
        QosTime,
    )

    for version in (8, 9):
        zero = QosTime(0, 0)
        profile = Qos(
            QosHistory.KEEP_LAST,
            7,
            QosReliability.RELIABLE,
            QosDurability.TRANSIENT_LOCAL,
            zero,
            zero,
            QosLiveliness.AUTOMATIC,
            zero,
            False,
        )
        with RosbagsWriter(tmp_path / f"v{version}", version=version) as writer:
            writer.add_connection(
                "/tf",
                TF,
                typestore=get_typestore(Stores.ROS2_JAZZY),
                offered_qos_profiles=[profile],
            )
        with open_bag(tmp_path / f"v{version}") as bag:
            (qos,) = bag.topics["/tf"].qos
        assert (qos.depth, qos.reliability, qos.durability) == (
            7,
            Reliability.RELIABLE,
            Durability.TRANSIENT_LOCAL,
        )
