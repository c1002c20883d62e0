"""MCAP files of other tools: names in two parts, types without text, channels of any kind."""

from __future__ import annotations

import sqlite3

import pytest
from mcap.writer import Writer
from tests.bags import START

from ros2cli.main import main as ros2
from turtlewire import Buffer
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.definitions import definition_text
from turtlewire.cli.main import main
from turtlewire.errors import CdrError, InterfaceError
from turtlewire.msg import get_message, registry, serialize

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
