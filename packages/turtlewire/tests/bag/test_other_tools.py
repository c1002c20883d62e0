"""MCAP files of other tools: names in two parts, types without text, channels of any kind.

Bags that other libraries write are read right, and their transforms end up in a buffer.
"""

import sqlite3

import pytest
from mcap.writer import CompressionType, IndexType, Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.typesys import Stores, get_typestore
from tests.bags import START, transform

from ros2cli.main import main as ros2
from turtlewire import Buffer, msg
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.definitions import definition_text
from turtlewire.cli.main import main
from turtlewire.errors import CdrError, InterfaceError
from turtlewire.msg import get_message, registry, serialize
from turtlewire.wire.qos import Durability, Reliability

String = get_message("std_msgs/msg/String")
TFMessage = get_message("tf2_msgs/msg/TFMessage")
Stamped = get_message("geometry_msgs/msg/TransformStamped")
EMPTY = b"\0\1\0\0\0"


def text(data="hi"):
    return serialize(String(data=data))


def tf():
    one = Stamped(child_frame_id="base")
    one.header.frame_id = "map"
    return serialize(TFMessage(transforms=[one]))


def ros(name):
    """The fields of a schema for a type of ROS, named in two parts."""
    return name.replace("/msg/", "/"), "ros2msg", definition_text(name).encode()


CHANNELS = [
    ("/text", "cdr", ros("std_msgs/msg/String"), text()),
    ("/tf", "cdr", ros("tf2_msgs/msg/TFMessage"), tf()),
    ("/empty", "cdr", ("std_msgs/Empty", "ros2msg", b""), EMPTY),
    ("/own_empty", "cdr", ("own_msgs/Nothing", "ros2msg", b""), EMPTY),
    ("/no_encoding", "", ros("std_msgs/msg/String"), text()),
    ("/no_name", "cdr", ("", "", b""), EMPTY),
    ("/no_schema", "cdr", None, EMPTY),
    ("/json", "json", ("demo/Pose", "jsonschema", b"{}"), b"{}"),
    ("/proto", "protobuf", ("foxglove.Log", "protobuf", b"\xff"), b"\x08\x01"),
    ("/unknown", "cdr", ("some_msgs/msg/Thing", "", b""), EMPTY),
    ("/odd_name", "cdr", ("a/b/c/d", "ros2msg", b"int8 x"), EMPTY),
    ("/bad", "cdr", ("bad_msgs/Thing", "ros2msg", b"this is ! bad"), EMPTY),
    ("/known_but_bad", "cdr", ("std_msgs/Bool", "ros2msg", b"this is ! bad"), EMPTY),
    ("/no_bytes", "cdr", ros("std_msgs/msg/String"), b""),
]
DECODED = {"/text", "/tf", "/empty", "/own_empty", "/no_encoding", "/known_but_bad"}


def write(path, channels=CHANNELS, **options):
    with path.open("wb") as file:
        writer = Writer(file, **options)
        writer.start("", "another tool")
        for number, (topic, encoding, schema, data) in enumerate(channels):
            schema_id = writer.register_schema(*schema) if schema else 0
            channel = writer.register_channel(topic, encoding, schema_id)
            writer.add_message(channel, log_time=START + number, publish_time=1, data=data)
        writer.finish()
    return path


def reasons(path):
    """Return why each topic is not decoded; empty for decoded topics."""
    found = {}
    with open_bag(path) as bag:
        for message in bag:
            try:
                message.decode()
                found[message.topic] = ""
            except (InterfaceError, CdrError) as error:
                found[message.topic] = str(error)
    return found


@pytest.mark.parametrize(
    "options", [{}, {"repeat_schemas": False}, {"repeat_channels": False}, {"use_chunking": False}]
)
def test_each_channel_is_decoded_or_named(tmp_path, options):
    found = reasons(write(tmp_path / "foreign.mcap", **options))
    assert {topic for topic, reason in found.items() if not reason} == DECODED
    assert len(found) == len(CHANNELS)
    assert found["/no_name"] == "/no_name: the bag does not name the type of its messages"
    assert found["/json"].endswith("its messages are in json")
    assert found["/unknown"] == "unknown interface 'some_msgs/msg/Thing'"
    assert "the bag's definition of bad_msgs/msg/Thing cannot be used" in found["/bad"]
    assert "a/b/c/d" in found["/odd_name"]


def test_the_doctor_names_topics_without_a_type(tmp_path, capsys):
    assert main(["doctor", str(write(tmp_path / "foreign.mcap"))]) == 0
    said = capsys.readouterr().out
    assert "neither decoded nor shown: /no_name, /no_schema." in said
    assert "/json (json demo/Pose), /proto (protobuf foxglove.Log)" in said


def test_names_in_two_parts_name_the_same_type(tmp_path):
    path = write(tmp_path / "foreign.mcap")
    assert Buffer.from_bag(path).can_transform("map", "base", 0)
    with open_bag(path) as bag:
        assert bag.topics["/text"].type == "std_msgs/msg/String"
        assert "std_msgs/msg/String" in bag.definitions()
        assert len(list(bag.messages(types="std_msgs/msg/String"))) == 3
        assert bag.topics["/json"].type == "demo/Pose"
    with BagWriter(tmp_path / "out") as writer:
        writer.add_topic("/a", "std_msgs/String")
        writer.add_topic("/a", "std_msgs/msg/String")
        writer.write("/a", String(data="x"), START)
        assert writer.topics["/a"].type == "std_msgs/msg/String"


def test_a_database_with_names_in_two_parts(tmp_path, capsys):
    folder = tmp_path / "db"
    with BagWriter(folder, storage="sqlite3") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/tf", tf(), START)
    database = sqlite3.connect(folder / "db_0.db3")
    for table, column in (("topics", "type"), ("message_definitions", "topic_type")):
        database.execute(f"UPDATE {table} SET {column} = 'tf2_msgs/TFMessage'")
    database.commit()
    database.close()
    metadata = folder / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("/msg/", "/"))
    for path in (folder, folder / "db_0.db3"):
        assert Buffer.from_bag(path).can_transform("map", "base", 0)
        assert ros2(["bag", "info", str(path)]) == 0
        assert "tf2_msgs/msg/TFMessage" in capsys.readouterr().out


def test_a_failed_lookup_is_remembered(tmp_path, monkeypatch):
    searches = []
    nearest = registry._nearest
    monkeypatch.setattr(registry, "_nearest", lambda name: searches.append(name) or nearest(name))
    channel = ("/unknown", "cdr", ("lost_msgs/msg/Thing", "", b""), EMPTY)
    path = write(tmp_path / "unknown.mcap", [channel] * 50)
    assert reasons(path)["/unknown"] == "unknown interface 'lost_msgs/msg/Thing'"
    assert searches == ["lost_msgs/msg/Thing"]


def test_an_interface_that_appears_later_is_found(tmp_path):
    with pytest.raises(InterfaceError):
        registry.interface_path("later_msgs/msg/Thing")
    (tmp_path / "msg").mkdir()
    (tmp_path / "msg" / "Thing.msg").write_text("int8 x\n")
    registry.add_package("later_msgs", str(tmp_path))
    try:
        assert registry.interface_path("later_msgs/msg/Thing").startswith(str(tmp_path))
    finally:
        del registry._registered["later_msgs"]


@pytest.mark.parametrize(
    "definition",
    [
        b"own_msgs/Knot knot",
        b"Other other\n" + b"=" * 80 + b"\nMSG: own_msgs/Other\nKnot[] knots\n",
        b"Missing x",
        b"int8 __class__",
        b"int8 x\nint8 x",
        b"\xff\xfe",
    ],
)
def test_a_definition_that_no_message_can_have(tmp_path, definition):
    channel = ("/knot", "cdr", ("own_msgs/Knot", "ros2msg", definition), EMPTY)
    found = reasons(write(tmp_path / "knot.mcap", [channel, CHANNELS[0]]))
    assert found["/knot"].startswith("the bag's definition of own_msgs/msg/Knot cannot be used: ")
    assert found["/text"] == ""


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


IDL = """\
#include "other_msgs/msg/Spot.idl"
module idl_msgs { module msg {
  module Blob_Constants { const int8 LARGE = 5; };
  struct Blob {
    @unit (value="m") double size;
    sequence<other_msgs::msg::Spot> spots;
  };
}; };
"""
SPOT = "module other_msgs { module msg { struct Spot { int32 x; string<4> name; }; }; };\n"


@pytest.mark.parametrize("starts_with_heading", [True, False])
def test_types_that_only_an_idl_file_defines(tmp_path, starts_with_heading):
    owner = f"idl_{starts_with_heading}".lower()
    name, line = f"{owner}/msg/Blob", "=" * 80
    text = f"{IDL.replace('idl_msgs', owner)}\n{line}\nIDL: other_msgs/msg/Spot\n{SPOT}"
    if starts_with_heading:
        text = f"{line}\nIDL: {name}\n{text}"
    path = tmp_path / "idl.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start("ros2", "test")
        schema = writer.register_schema(name, "ros2idl", text.encode())
        channel = writer.register_channel("/blob", "cdr", schema)
        size, spot = b"\0\1\0\0" + bytes(6) + b"\x04\x40", b"\1\0\0\0\7\0\0\0\2\0\0\0a\0"
        writer.add_message(channel, log_time=START, publish_time=START, data=size + spot)
        writer.finish()
    with open_bag(path) as bag:
        (message,) = bag.messages()
        blob = message.decode()
    assert (blob.size, blob.LARGE) == (2.5, 5)
    assert [(each.x, each.name) for each in blob.spots] == [(7, "a")]
