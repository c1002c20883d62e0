"""Reading bags through rosbag2's classes gives what the real one gives."""

import gzip
import json
import zlib

import pytest
from tests.programs import run_python

import rosbag2_py
from rclpy.serialization import deserialize_message
from std_msgs.msg import String
from tests import places

GOLDEN = places.GOLDEN / "bag"
BAGS = ["d_mcap", "d_split_file_zstd", "d_sqlite3_message_zstd"]


@pytest.fixture(params=BAGS)
def bag(request):
    return request.param


@pytest.fixture
def golden(bag):
    return json.loads((GOLDEN / "reads.json").read_text())[bag]["reads"]


@pytest.fixture
def reader(bag):
    reader = rosbag2_py.SequentialReader()
    reader.open(
        rosbag2_py.StorageOptions(uri=str(GOLDEN / bag)), rosbag2_py.ConverterOptions("cdr", "cdr")
    )
    yield reader
    reader.close()


def rows_of(reader):
    rows = []
    while reader.has_next():
        topic, data, stamp = reader.read_next()
        rows.append([topic, stamp, len(data), zlib.crc32(data)])
    return rows


def short(rows):
    crc = zlib.crc32(json.dumps(rows).encode())
    return {"count": len(rows), "first": rows[:2], "last": rows[-2:], "crc": crc}


def all_messages(bag):
    with gzip.open(GOLDEN / "messages.json.gz", "rt") as file:
        return json.load(file)[bag]


def test_topics_and_definitions(reader, golden):
    topics = reader.get_all_topics_and_types()
    assert sorted([t.name, t.type, t.serialization_format] for t in topics) == golden["topics"]
    found = reader.get_all_message_definitions()
    assert sorted([d.topic_type, d.encoding] for d in found) == golden["definitions"]


@pytest.mark.parametrize(
    ("name", "chosen"),
    [
        ("filter topics", {"topics": ["/tf", "/notes"]}),
        ("filter regex", {"regex": "/(goal|deep)/.*"}),
        ("filter regex of a part", {"regex": "/goal"}),
        ("filter exclude", {"exclude_topics": ["/tf", "/scan"]}),
    ],
)
def test_filters(reader, golden, name, chosen):
    reader.set_filter(rosbag2_py.StorageFilter(**chosen))
    assert short(rows_of(reader)) == golden[name]


def test_seek(bag, reader, golden):
    times = sorted(row[1] for row in all_messages(bag))
    reader.seek(times[len(times) * 2 // 5])
    assert short(rows_of(reader)) == golden["seek"]


def test_a_filter_can_be_lifted(reader, golden):
    reader.set_filter(rosbag2_py.StorageFilter(topics=["/scan"]))
    first = [reader.read_next()[0] for _ in range(3)]
    reader.reset_filter()
    assert [first, reader.read_next()[0]] == golden["reset filter"]


@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize("order", ["ReceivedTimestamp", "PublishedTimestamp", "File"])
def test_orders(reader, golden, order, reverse, capsys):
    key = f"order {order}{' reverse' if reverse else ''}"
    if key not in golden:
        assert reverse  # the real one was asked for these in one direction only
        return
    sort_by = getattr(rosbag2_py.ReadOrderSortBy, order)
    possible = reader.set_read_order(rosbag2_py.ReadOrder(sort_by=sort_by, reverse=reverse))
    assert [possible, short(rows_of(reader))] == golden[key]
    assert ("not supported" in capsys.readouterr().err) == (not possible)


def test_backwards_from_the_end(bag, reader):
    reader.set_read_order(rosbag2_py.ReadOrder(reverse=True))
    expected = all_messages(bag)
    reader.seek(expected[-1][1])
    assert [row[1] for row in rows_of(reader)] == [row[1] for row in reversed(expected)]


def test_end_and_mistakes(reader, tmp_path):
    rows_of(reader)
    with pytest.raises(RuntimeError, match="Bag is at end"):
        reader.read_next()
    with pytest.raises(RuntimeError, match="No plugin detected that could open file"):
        rosbag2_py.SequentialReader().open_uri(str(tmp_path / "nothing"))
    with pytest.raises(RuntimeError, match="Bag is not open"):
        rosbag2_py.SequentialReader().has_next()


def test_a_script_that_writes_and_reads(tmp_path):
    """The writing tutorial's calls, and a reader for its bag."""
    from rclpy.serialization import serialize_message

    writer = rosbag2_py.SequentialWriter()
    storage = rosbag2_py.StorageOptions(uri=str(tmp_path / "my_bag"), storage_id="sqlite3")
    writer.open(storage, rosbag2_py.ConverterOptions("", ""))
    topic = rosbag2_py.TopicMetadata(
        id=0, name="chatter", type="std_msgs/msg/String", serialization_format="cdr"
    )
    writer.create_topic(topic)
    for i in range(5):
        writer.write("chatter", serialize_message(String(data=f"hello {i}")), 1000 + i)
    with pytest.raises(RuntimeError, match=r"Failed to write on topic 'other'\. Call create_topic"):
        writer.write("other", b"", 1)
    del writer
    reader = rosbag2_py.SequentialReader()
    reader.open_uri(str(tmp_path / "my_bag"))
    texts = []
    while reader.has_next():
        name, data, stamp = reader.read_next()
        texts.append((name, deserialize_message(data, String).data, stamp))
    assert texts == [("chatter", f"hello {i}", 1000 + i) for i in range(5)]
    assert reader.get_metadata().message_count == 5
    reader.close()


def test_a_program_that_ends_finishes_its_bag(tmp_path):
    """The tutorial's recorder is an attribute of a node, and nobody closes it."""
    program = (
        "import sys, rosbag2_py\n"
        "class Node: pass\n"
        "node = Node(); node.itself = node\n"
        "node.writer = rosbag2_py.SequentialWriter()\n"
        "node.writer.open(rosbag2_py.StorageOptions(uri=sys.argv[1], storage_id='mcap'))\n"
        "sys.kept = node\n"
    )
    run = run_python(program, str(tmp_path / "bag"))
    assert run.stderr == ""
    assert (tmp_path / "bag" / "metadata.yaml").exists()


def test_writers_refuse_what_cannot_be(tmp_path):
    writer = rosbag2_py.SequentialWriter()
    with pytest.raises(RuntimeError, match="Bag is not open"):
        writer.split_bagfile()
    options = rosbag2_py.StorageOptions(uri=str(tmp_path))
    with pytest.raises(RuntimeError, match=r"Bag directory already exists .*can't overwrite"):
        writer.open(options)
    options = rosbag2_py.StorageOptions(uri=str(tmp_path / "a"), max_bagfile_size=10)
    with pytest.raises(RuntimeError, match="Invalid bag splitting size given"):
        writer.open(options)


def test_metadata_comes_back(bag, tmp_path):
    io = rosbag2_py.MetadataIo()
    metadata = io.read_metadata(str(GOLDEN / bag))
    io.write_metadata(str(tmp_path), metadata)
    assert io.metadata_file_exists(str(tmp_path))
    again = io.read_metadata(str(tmp_path))
    assert again.topics_with_message_count == metadata.topics_with_message_count
    assert io.deserialize_metadata(io.serialize_metadata(metadata)).custom_data == (
        metadata.custom_data
    )
