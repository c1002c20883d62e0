"""Converting bags of ROS 1 and of other definitions, with `rosbags` as the oracle; early ends."""

import random
import sqlite3
from contextlib import closing

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore
from tests.bags import START
from tests.places import GOLDEN
from tests.rosbags_messages import assert_contains, contents, random_message, write_ros1

from ros2cli.main import main
from rosbag2_py import SequentialReader
from rosbag2_transport.options import RecordOptions
from rosbag2_transport.rewrite import Output, rewrite
from turtlewire.bag import BagWriter, open_bag

ROS1 = get_typestore(Stores.ROS1_NOETIC)
FOXY = get_typestore(Stores.ROS2_FOXY)
JAZZY = get_typestore(Stores.ROS2_JAZZY)


def convert(tmp_path, name, *inputs, storage="mcap"):
    """Run ``ros2 bag convert`` into a folder; returns its exit code."""
    options = tmp_path / f"{name}.yaml"
    options.write_text(
        f"output_bags:\n- uri: {tmp_path / name}\n  storage_id: {storage}\n  all: true\n"
    )
    words = [word for path in inputs for word in ("-i", str(path))]
    return main(["bag", "convert", *words, "-o", str(options)])


@pytest.mark.slow
def test_all_types_from_ros1_to_mcap_to_sqlite_to_mcap(tmp_path):
    # rosbags expects another hash of Char than ROS 2 has, and then reads nothing.
    write_ros1(tmp_path / "old.bag", ROS1, sorted(ROS1.fielddefs.keys() - {"std_msgs/msg/Char"}))
    assert convert(tmp_path, "one", tmp_path / "old.bag") == 0
    assert convert(tmp_path, "two", tmp_path / "one", storage="sqlite3") == 0
    assert convert(tmp_path, "three", tmp_path / "two") == 0
    expected = contents(tmp_path / "old.bag")
    assert len(expected) > 400
    for name in ("one", "two", "three"):
        found = contents(tmp_path / name)
        assert [each[:2] for each in found] == [each[:2] for each in expected]
        for (topic, _, message), (_, _, old) in zip(found, expected, strict=True):
            assert_contains(message, old, f"{name} {topic}")


def test_characters_of_ros1(tmp_path):
    """`rosbags` does not read this type from bags of ROS 2, but decodes its bytes."""
    name = "std_msgs/msg/Char"
    (raw,) = write_ros1(tmp_path / "old.bag", ROS1, [name]).values()
    assert convert(tmp_path, "one", tmp_path / "old.bag") == 0
    assert convert(tmp_path, "two", tmp_path / "one", storage="sqlite3") == 0
    assert convert(tmp_path, "three", tmp_path / "two") == 0
    (path,) = (tmp_path / "three").glob("*.mcap")
    with path.open("rb") as stream:
        found = [message.data for _, _, message in make_reader(stream).iter_messages()]
    assert len(found) == 3
    for data, old in zip(found, raw, strict=True):
        assert JAZZY.deserialize_cdr(data, name).data == ROS1.deserialize_ros1(old, name).data


@pytest.mark.slow
@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_all_types_of_ros2_through_both_storages(tmp_path, plugin):
    dice = random.Random(3)
    names = sorted(JAZZY.fielddefs.keys() - {"std_msgs/msg/Char"})
    with Writer2(tmp_path / "old", version=9, storage_plugin=plugin) as writer:
        for name in names:
            connection = writer.add_connection(f"/{name}", name, typestore=JAZZY)
            for number in range(3):
                message = random_message(JAZZY, name, dice)
                writer.write(connection, START + number, bytes(JAZZY.serialize_cdr(message, name)))
    assert convert(tmp_path, "one", tmp_path / "old") == 0
    assert convert(tmp_path, "two", tmp_path / "one", storage="sqlite3") == 0
    assert convert(tmp_path, "three", tmp_path / "two") == 0
    expected = contents(tmp_path / "old")
    assert len(expected) == 3 * len(names) > 450
    for name in ("one", "two", "three"):
        found = contents(tmp_path / name)
        assert [each[:2] for each in found] == [each[:2] for each in expected]
        for (topic, _, message), (_, _, old) in zip(found, expected, strict=True):
            assert_contains(message, old, f"{name} {topic}")


def test_messages_of_an_older_ros2_without_definitions_are_upgraded(tmp_path):
    name = "sensor_msgs/msg/Range"
    plugin = StoragePlugin.SQLITE3
    with Writer2(tmp_path / "old", version=8, storage_plugin=plugin) as writer:
        connection = writer.add_connection("/range", name, typestore=FOXY)
        message = random_message(FOXY, name, random.Random(1))
        writer.write(connection, START, bytes(FOXY.serialize_cdr(message, name)))
    with closing(sqlite3.connect(tmp_path / "old" / "old.db3")) as database:
        database.execute("DROP TABLE message_definitions")
    assert convert(tmp_path, "out", tmp_path / "old") == 0
    ((_, _, found),) = contents(tmp_path / "out")
    assert (found.range, found.variance) == (message.range, 0.0)


def test_a_topic_that_cannot_be_converted_is_named(tmp_path, capfd):
    with Writer(tmp_path / "odd.bag") as writer:
        odd = writer.add_connection(
            "/odd", "odd/msg/One", msgdef="no definition\n", md5sum="0" * 32
        )
        writer.write(odd, START, b"abc")
        text = writer.add_connection("/text", "std_msgs/msg/String", typestore=ROS1)
        writer.write(text, START + 1, b"\2\0\0\0hi")
    assert convert(tmp_path, "out", tmp_path / "odd.bag") == 1
    assert "left out: /odd (ros1 odd/msg/One)." in capfd.readouterr().err
    with open_bag(tmp_path / "out") as bag:
        assert [(each.topic, each.decode().data) for each in bag] == [("/text", "hi")]


def test_each_topic_that_loses_messages_is_named(tmp_path, capfd):
    with Writer(tmp_path / "odd.bag") as writer:
        odd = writer.add_connection(
            "/odd", "odd/msg/One", msgdef="no definition\n", md5sum="0" * 32
        )
        writer.write(odd, START, b"abc")
        for name in ("/one", "/two"):
            text = writer.add_connection(name, "std_msgs/msg/String", typestore=ROS1)
            writer.write(text, START + 1, b"\2\0\0\0hi")
            writer.write(text, START + 2, b"\3\0\0\0hi")
    assert convert(tmp_path, "out", tmp_path / "odd.bag") == 1
    said = capfd.readouterr().err
    assert "left out: /odd (ros1 odd/msg/One)." in said
    for name in ("/one", "/two"):
        assert f"left out 1 message of {name}: " in said
    assert said.count("its 6 bytes do not follow its definition: they end too early") == 2
    with open_bag(tmp_path / "out") as bag:
        assert [each.topic for each in bag] == ["/one", "/two"]


def test_messages_without_bytes_do_not_end_a_conversion(tmp_path, capfd):
    with (tmp_path / "short.mcap").open("wb") as file:
        writer = McapWriter(file)
        writer.start()
        schema = writer.register_schema("std_msgs/String", "ros2msg", b"string data")
        channel = writer.register_channel("/text", "cdr", schema)
        for number, data in enumerate([b"", b"\0\1\0\0\3\0\0\0hi\0"]):
            writer.add_message(channel, START + number, data, START)
        writer.finish()
    assert convert(tmp_path, "out", tmp_path / "short.mcap") == 1
    assert "Messages of /text have no bytes: left out." in capfd.readouterr().err
    with open_bag(tmp_path / "out") as bag:
        assert [each.decode().data for each in bag] == ["hi"]


def test_a_refused_conversion_leaves_no_bag(tmp_path, capfd):
    with Writer(tmp_path / "odd.bag") as writer:
        odd = writer.add_connection(
            "/odd", "odd/msg/Two", msgdef="no definition\n", md5sum="0" * 32
        )
        writer.write(odd, START, b"abc")
    assert convert(tmp_path, "out", tmp_path / "odd.bag") == 1
    assert "/odd (ros1 odd/msg/Two)" in capfd.readouterr().err
    options = tmp_path / "two.yaml"
    options.write_text(
        f"output_bags:\n- {{uri: {tmp_path / 'out'}, all: true}}\n"
        f"- {{uri: {tmp_path / 'odd.bag'}, all: true}}\n"
    )
    assert main(["bag", "convert", "-i", str(tmp_path / "odd.bag"), "-o", str(options)]) == 1
    options.write_text(f"output_bags:\n- {{uri: {tmp_path / 'out'}, regex: '('}}\n")
    assert main(["bag", "convert", "-i", str(tmp_path / "odd.bag"), "-o", str(options)]) == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("storage", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_bags_of_different_definitions_are_merged_by_ours(tmp_path, storage):
    name = "sensor_msgs/msg/Range"
    written = []
    for number, store in enumerate([FOXY, JAZZY]):
        message = random_message(store, name, random.Random(number))
        written.append(message)
        with Writer2(tmp_path / f"in{number}", version=9, storage_plugin=storage) as writer:
            connection = writer.add_connection("/range", name, typestore=store)
            writer.write(connection, START + number, store.serialize_cdr(message, name))
    assert convert(tmp_path, "out", tmp_path / "in0", tmp_path / "in1") == 0
    found = [message for _, _, message in contents(tmp_path / "out")]
    assert_contains(found, written)
    assert [found[0].variance, found[1].variance] == [0.0, written[1].variance]


def test_scripts_read_older_messages_as_those_that_are_installed(tmp_path):
    name = "sensor_msgs/msg/Range"
    message = random_message(FOXY, name, random.Random(1))
    with Writer2(tmp_path / "old", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/range", name, typestore=FOXY)
        writer.write(connection, START, FOXY.serialize_cdr(message, name))
    reader = SequentialReader()
    reader.open_uri(str(tmp_path / "old"))
    _, data, _ = reader.read_next()
    reader.close()
    assert_contains(JAZZY.deserialize_cdr(data, name), message)


SMALL = GOLDEN / "bag" / "p_small"


def test_an_interrupted_conversion_says_so_and_leaves_no_half_bag(tmp_path, capfd):
    def interrupt(*_):
        raise KeyboardInterrupt

    writer = BagWriter(tmp_path / "half", max_file_ns=1_000_000_000)
    writer.on_split = interrupt  # after a second of the bag
    with open_bag(SMALL) as bag, pytest.raises(KeyboardInterrupt):
        rewrite([bag], [Output(writer, RecordOptions(all_topics=True))])
    lines = capfd.readouterr().err.splitlines()
    assert len(lines) == 1
    assert "what was converted is incomplete and removed" in lines[0]
    assert str(tmp_path / "half") in lines[0]
    assert not (tmp_path / "half").exists()


@pytest.mark.parametrize(
    ("start_ns", "end_ns", "written"),
    [
        (-1, -1, [0, 10, 20, 30]),
        (0, 0, [0]),
        (10, 20, [10, 20]),
        (11, 19, []),
        (9, 21, [10, 20]),
        (30, -1, [30]),
        (31, -1, []),
    ],
)
def test_both_ends_of_an_output_belong_to_it(tmp_path, start_ns, end_ns, written):
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for time in (0, 10, 20, 30):
            writer.write("/a", bytes(8), time)
    output = BagWriter(tmp_path / "part")
    with open_bag(tmp_path / "bag") as bag:
        rewrite([bag], [Output(output, RecordOptions(all_topics=True), start_ns, end_ns)])
    with open_bag(tmp_path / "part") as bag:
        assert [message.log_time_ns for message in bag] == written
