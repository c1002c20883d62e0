"""Bags written here are read back as they were written, by us and by other libraries."""

import os
import re
import sqlite3
import subprocess
import sys
from contextlib import ExitStack

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from tests.bags import START, contents, transform, write_bag
from tests.disks import full_disk

import turtlewire
from turtlewire import msg
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.file_series import FileSeries
from turtlewire.bag.sqlite_writer import SqliteWriter
from turtlewire.errors import BagError
from turtlewire.wire.qos import INFINITE_NS, Durability, History, Liveliness, QoS, Reliability

WAYS = {
    "mcap": {},
    "mcap zstd": {"compression": "zstd"},
    "mcap lz4": {"compression": "lz4"},
    "mcap small chunks": {"compression": "zstd", "chunk_bytes": 1000},
    "mcap split": {"max_file_bytes": 4000, "chunk_bytes": 1000},
    "mcap split by time": {"max_file_ns": 300_000_000},
    "mcap file": {"compression_mode": "FILE", "max_file_bytes": 4000, "chunk_bytes": 1000},
    "sqlite3": {"storage": "sqlite3"},
    "sqlite3 split": {"storage": "sqlite3", "max_file_bytes": 4000},
    "sqlite3 file": {"storage": "sqlite3", "compression_mode": "FILE"},
    "sqlite3 message": {"storage": "sqlite3", "compression_mode": "MESSAGE"},
}


@pytest.mark.parametrize("way", WAYS)
def test_written_data_is_read(tmp_path, way):
    with open_bag(write_bag(tmp_path / "plain")) as plain:
        expected = contents(plain)
        topics = plain.topics
    with open_bag(write_bag(tmp_path / "made", **WAYS[way])) as bag:
        assert contents(bag) == expected
        assert bag.topics == topics
        assert bag.problems == []
        assert (len(bag.metadata.paths) > 1) == ("split" in way or way == "mcap file")
        assert sum(file.message_count for file in bag.metadata.files) == len(expected)
        texts = bag.columns("/chatter", "data")["data"]
        assert list(texts) == [f"number {i}" for i in range(9, 100, 10)]
    buffer = turtlewire.Buffer.from_bag(tmp_path / "made")
    assert buffer.can_transform("odom", "camera", START + 500_000_000)


@pytest.mark.parametrize("way", [way for way in WAYS if "sqlite3" in way])
def test_a_database_can_be_finished_while_somebody_reads_it(tmp_path, way):
    text = msg.get_message("std_msgs/msg/String")
    with BagWriter(tmp_path / "made", **WAYS[way]) as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
        for number in range(100):
            writer.write("/chatter", text(data=f"number {number}"), START + number)
            if number == 10:
                writer.flush()
                reader = sqlite3.connect(tmp_path / "made" / "made_0.db3")
                rows = reader.execute("SELECT * FROM messages")
                rows.fetchone()
    rows.close()
    reader.close()
    assert not list((tmp_path / "made").glob("*-*"))  # no log is left
    with open_bag(tmp_path / "made") as bag:
        assert [m.decode().data for m in bag] == [f"number {number}" for number in range(100)]
        assert bag.problems == []


@pytest.mark.parametrize("way", [way for way in WAYS if "file" not in way])
def test_rosbags_reads_it(tmp_path, way):
    folder = write_bag(tmp_path / "made", custom_data={"robot": "a: 1"}, **WAYS[way])
    with open_bag(folder) as bag:
        expected = [(m.topic, m.log_time_ns, m.data) for m in bag]
    with AnyReader([folder]) as reader:
        found = [(c.topic, stamp, bytes(data)) for c, stamp, data in reader.messages()]
        counts = {c.topic: c.msgcount for c in reader.connections}
        assert {c.msgtype for c in reader.connections if c.topic == "/chatter"} == {
            "std_msgs/msg/String"
        }
        assert (reader.start_time, reader.duration) == (START, 991_000_002)
    assert found == expected
    assert counts == {"/tf": 100, "/tf_static": 1, "/chatter": 10}


@pytest.mark.parametrize("way", ["mcap", "mcap zstd", "mcap lz4", "mcap small chunks"])
def test_mcap_reads_it(tmp_path, way):
    folder = write_bag(tmp_path / "made", **WAYS[way])
    with open_bag(folder) as bag:
        expected = [(m.topic, m.log_time_ns, m.publish_time_ns, m.data) for m in bag]
        definitions = bag.definitions()
    with (folder / "made_0.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        found = [
            (channel.topic, message.log_time, message.publish_time, message.data)
            for _, channel, message in reader.iter_messages()
        ]
        summary = reader.get_summary()
        assert reader.get_header().profile == "ros2"
    assert found == expected
    assert summary.statistics.message_count == 111
    assert {s.name: (s.encoding, s.data.decode()) for s in summary.schemas.values()} == definitions


def test_other_libraries_decode_with_the_definitions_in_it(tmp_path):
    folder = write_bag(tmp_path / "made", count=3)
    with (folder / "made_0.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        decoded = [found[3] for found in reader.iter_decoded_messages(topics=["/tf"])]
    assert [m.transforms[0].transform.translation.x for m in decoded] == [0.0, 0.01, 0.02]
    assert decoded[0].transforms[0].header.frame_id == "odom"


@settings(max_examples=50)
@given(
    st.builds(
        QoS,
        history=st.sampled_from(History),
        depth=st.integers(0, 2**31),
        reliability=st.sampled_from([r for r in Reliability if r < 4]),
        durability=st.sampled_from([d for d in Durability if d < 4]),
        deadline_ns=st.integers(0, 2**40) | st.just(INFINITE_NS),
        lifespan_ns=st.integers(0, 2**40) | st.just(INFINITE_NS),
        liveliness=st.sampled_from([x for x in Liveliness if x < 5]),
        liveliness_lease_ns=st.integers(0, 2**40) | st.just(INFINITE_NS),
        avoid_ros_namespace_conventions=st.booleans(),
    )
)
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_qos_comes_back(tmp_path_factory, storage, qos):
    folder = tmp_path_factory.mktemp("qos") / "bag"
    with BagWriter(folder, storage=storage) as writer:
        writer.add_topic("/a", "std_msgs/msg/String", qos=[qos, QoS()])
    with open_bag(folder) as bag:
        assert bag.topics["/a"].qos == [qos, QoS()]
    (folder / "metadata.yaml").unlink()
    with open_bag(folder) as bag:
        assert bag.topics["/a"].qos == [qos, QoS()]


def test_mistakes(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        writer.add_topic("/a", "std_msgs/msg/String")
        with pytest.raises(BagError, match="has the type std_msgs/msg/String already"):
            writer.add_topic("/a", "std_msgs/msg/Bool")
        with pytest.raises(BagError, match="'/b' was not added") as error:
            writer.write("/b", b"\0\1\0\0", 1)
        assert error.value.hint.startswith("Call add_topic() first: bytes")
    writer.close()
    with pytest.raises(BagError, match="is closed"):
        writer.write("/a", b"\0\1\0\0", 1)
    with pytest.raises(FileExistsError, match=r"choose another path, or remove .* '.*/made'"):
        BagWriter(tmp_path / "made")
    with pytest.raises(BagError, match="unknown storage 'mcp'"):
        BagWriter(tmp_path / "other", storage="mcp")
    with pytest.raises(BagError, match="unknown compression 'gzip'"):
        BagWriter(tmp_path / "other", compression="gzip")
    with pytest.raises(BagError, match="compress chunks, not messages"):
        BagWriter(tmp_path / "another", compression_mode="MESSAGE")
    assert not (tmp_path / "another").exists()


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_times_are_checked_where_they_are_given(tmp_path, storage):
    """What could not be written must not spoil the bag when it is closed."""
    with BagWriter(tmp_path / "made", storage=storage) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        time = np.datetime64("2001-09-09T01:46:40", "s")
        writer.write("/a", msg.get_message("std_msgs/msg/String")(data="x"), time, time)
        writer.write("/a", b"\0\1\0\0", np.int64(10**18 + 1))
        with pytest.raises(ValueError, match="log_time_ns is -1: bags have no times before 1970"):
            writer.write("/a", b"\0\1\0\0", -1)
        with pytest.raises(TypeError, match="log_time_ns must be an int of nanoseconds"):
            writer.write("/a", b"\0\1\0\0", 1.5)
        with pytest.raises(TypeError, match="or its CDR bytes, not int"):
            writer.write("/a", 3, 1)
    with open_bag(tmp_path / "made") as bag:
        assert [message.log_time_ns for message in bag] == [10**18, 10**18 + 1]


def test_an_empty_bag(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
    with open_bag(tmp_path / "made") as bag:
        assert list(bag) == []
        assert (bag.start_ns, bag.end_ns) == (0, 0)
        assert list(bag.topics) == ["/a"]


def test_a_type_that_is_not_known_can_be_written(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        with pytest.warns(UserWarning, match="no definition of no_such/msg/Thing"):
            writer.add_topic("/a", "no_such/msg/Thing")
        writer.write("/a", b"\0\1\0\0", 5)
    with open_bag(tmp_path / "made") as bag:
        assert bag.definitions() == {"no_such/msg/Thing": ("unknown", "")}
        assert [m.data for m in bag] == [b"\0\1\0\0"]


def test_messages_and_bytes_are_the_same(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/tf", transform(3), 1)
        writer.write("/tf", msg.serialize(transform(3)), 2)
    with open_bag(tmp_path / "made") as bag:
        first, second = (message.data for message in bag)
        assert first == second


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("version", range(1, 10))
def test_every_version_of_the_metadata(tmp_path, version, storage):
    """What a version has no key for is not written, and is read as if it were empty."""
    path = write_bag(
        tmp_path / "made",
        storage=storage,
        metadata_version=version,
        ros_distro="jazzy",
        custom_data={"robot": "r1"},
        max_file_bytes=5000,
    )
    text = (path / "metadata.yaml").read_text()
    written = yaml.safe_load(text)["rosbag2_bagfile_information"]
    topics = {
        each["topic_metadata"]["name"]: each["topic_metadata"]
        for each in written["topics_with_message_count"]
    }
    offered = topics["/tf"].get("offered_qos_profiles")
    since = {"compression_mode": 3, "files": 5, "custom_data": 6, "ros_distro": 8}
    assert {key for key in since if key in written} == {k for k, v in since.items() if v <= version}
    assert ("type_description_hash" in topics["/tf"]) == (version >= 7)
    assert (offered is None) == (version < 4)
    if offered is not None:
        assert isinstance(offered, str) == (version < 9)
        (profile,) = yaml.safe_load(offered) if version < 9 else offered
        keep_last = "keep_last" if version > 8 else 1
        assert (profile["history"], profile["depth"]) == (keep_last, 100)
    with open_bag(path) as bag:
        assert (bag.metadata.version, len(bag), len(list(bag))) == (version, 111, 111)
        assert bag.metadata.custom_data == ({"robot": "r1"} if version >= 6 else {})
        depths = [qos.depth for qos in bag.topics["/tf"].qos]
        assert depths == ([100] if version >= 4 else [])
    with AnyReader([path]) as reader:
        assert sum(1 for _ in reader.messages()) == 111
    (path / "metadata.yaml").unlink()  # the QoS in the files is in the same style
    with open_bag(path) as bag:
        assert [qos.depth for qos in bag.topics["/tf"].qos] == depths


@pytest.mark.parametrize(
    "options", [{"compression": "gz"}, {"compression": None}, {"compression_mode": "FLE"}]
)
def test_a_wrong_compression_leaves_no_folder(tmp_path, options):
    with pytest.raises(BagError, match="unknown compression"):
        BagWriter(tmp_path / "made", **options)
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_version_of_the_metadata(tmp_path):
    with pytest.raises(BagError, match="unknown version 10 of the metadata"):
        BagWriter(tmp_path / "made", metadata_version=10)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_messages_that_a_topic_does_not_hold(tmp_path, storage):
    with BagWriter(tmp_path / "made", storage=storage) as writer:
        writer.add_topic("/s", "std_msgs/msg/String")
        with pytest.raises(TypeError, match=r"/s holds std_msgs/msg/String, not tf2_msgs/msg/TF"):
            writer.write("/s", transform(0), 1)
        with pytest.raises(TypeError, match=r"/s accepts a std_msgs/msg/String.*not str"):
            writer.write("/s", "hello", 1)
        for empty in (b"", bytearray()):
            with pytest.raises(BagError, match=r"/s accepts a std_msgs/msg/String.*not 0 bytes"):
                writer.write("/s", empty, 1)
        writer.write("/s", bytearray(b"\0\1\0\0"), 1)
    with open_bag(tmp_path / "made") as bag:
        assert len(list(bag)) == 1


@pytest.mark.parametrize(
    "options",
    [
        {"storage": "sqlite3", "compression": "zstd"},
        {"storage": "sqlite3", "compression": "lz4"},
        {"max_file_bytes": -4},
        {"max_file_ns": -1},
        {"max_files": -1},
        {"chunk_bytes": 0},
    ],
)
def test_options_without_effect_are_refused(tmp_path, options):
    with pytest.raises(BagError):
        BagWriter(tmp_path / "made", **options)
    assert not (tmp_path / "made").exists()


def test_a_name_that_is_not_utf_8_is_refused(tmp_path):
    """The messages would be written, and metadata.yaml not."""
    with pytest.raises(BagError, match=r"^the name 'l\\udce9' is not UTF-8"):
        BagWriter(tmp_path / "l\udce9")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("max_file_ns", "counts"), [(0, [4]), (9, [1, 1, 2]), (10, [2, 2])])
def test_a_message_at_the_end_of_a_file_belongs_to_it(tmp_path, max_file_ns, counts):
    with BagWriter(tmp_path / "made", max_file_ns=max_file_ns) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for time in (100, 110, 120, 120):
            writer.write("/a", bytes(8), time)
    assert [file.message_count for file in writer.metadata.files] == counts


@pytest.mark.parametrize(("chunk_bytes", "chunks"), [(77, 3), (78, 3), (79, 2)])
def test_a_chunk_ends_when_its_size_is_reached(tmp_path, chunk_bytes, chunks):
    with BagWriter(tmp_path / "made", chunk_bytes=chunk_bytes) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for time in range(6):
            writer.write("/a", bytes(8), time)  # a record of 39 bytes
    with open(tmp_path / "made" / "made_0.mcap", "rb") as file:
        indexes = make_reader(file).get_summary().chunk_indexes
    assert sum(bool(index.message_index_offsets) for index in indexes) == chunks


def test_the_length_of_a_file_counts_from_its_first_message_after_a_split(tmp_path):
    with BagWriter(tmp_path / "made", max_file_ns=10) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        writer.write("/a", bytes(8), 100)
        writer.split()
        for time in (120, 130, 131):
            writer.write("/a", bytes(8), time)
    assert [file.message_count for file in writer.metadata.files] == [1, 2, 1]


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("step", ["_finish", "_new_file"])
def test_a_bag_that_cannot_begin_another_file_is_closed(tmp_path, monkeypatch, storage, step):
    writer = BagWriter(tmp_path / "made", storage=storage)
    writer.add_topic("/a", "std_msgs/msg/String")
    writer.write("/a", bytes(8), 1)
    original = getattr(FileSeries, step)

    def full(*arguments):
        if step == "_finish":
            original(*arguments)
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(FileSeries, step, full)
    with pytest.raises(OSError, match="No space left"):
        writer.split()
    writer.close()
    with pytest.raises(BagError, match="is closed"):
        writer.write("/a", bytes(8), 2)
    with open_bag(tmp_path / "made") as bag:
        assert [message.log_time_ns for message in bag] == [1]
        assert (len(bag), len(bag.metadata.paths)) == (1, 1)


def test_reading_a_running_recording_keeps_the_lock_of_its_writer(tmp_path):
    read = "import sys; from turtlewire.bag import open_bag; print(len(open_bag(sys.argv[1])))"
    command = [sys.executable, "-c", read, str(tmp_path / "made")]
    with BagWriter(tmp_path / "made", storage="sqlite3", ros_distro="jazzy") as writer:
        writer.write("/tf", transform(1), 1)
        writer.flush()
        with open_bag(tmp_path / "made") as bag:
            assert [message.log_time_ns for message in bag] == [1]
        assert subprocess.check_output(command, text=True) == "1\n"
        # Without the lock of the writer, the reader that closes the file last removes its log.
        assert (tmp_path / "made" / "made_0.db3-wal").exists()


def test_a_log_that_cannot_be_merged_is_an_error_in_any_folder(tmp_path):
    folder = tmp_path / "blocked"  # contains "locked", as sqlite3's error about other readers does
    folder.mkdir()
    writer = SqliteWriter(str(folder / "a.db3"), "jazzy")
    writer.write(writer.add_topic("/a", "std_msgs/msg/String", "", ""), 1, 1, bytes(300_000))
    writer.flush()
    with full_disk(100_000), pytest.raises(OSError, match="disk"):
        writer.close()


def test_a_closed_database_is_not_reported_as_a_fault_of_the_disk(tmp_path):
    writer = SqliteWriter(str(tmp_path / "a.db3"), "jazzy")
    writer.close()
    with pytest.raises(sqlite3.ProgrammingError, match="closed database"):
        writer.add_topic("/a", "std_msgs/msg/String", "", "")


@pytest.mark.parametrize("way", ["mcap", "sqlite3", "sqlite3 that is read"])
def test_without_room_to_compress_a_file_stays_as_it_is(tmp_path, way):
    storage = way.split()[0]
    writer = BagWriter(tmp_path / "made", storage=storage, compression_mode="FILE")
    noise = np.random.default_rng(0).bytes(400_000)
    writer.write("/noise", msg.get_message("std_msgs/msg/UInt8MultiArray")(data=noise), 1)
    writer.flush()
    reader = sqlite3.connect(writer.file_path if "read" in way else ":memory:")
    rows = reader.execute("SELECT * FROM sqlite_schema")  # keeps the log next to the file
    with ExitStack() as disk:
        writer.on_compress = lambda _: disk.enter_context(full_disk(100_000))
        with pytest.raises(OSError):
            writer.close()
    rows.close()
    reader.close()
    name = {"mcap": "made_0.mcap", "sqlite3": "made_0.db3"}[storage]
    assert {path.name for path in (tmp_path / "made").iterdir()} == {name, "metadata.yaml"}
    with open_bag(tmp_path / "made") as bag:
        assert [bytes(message.decode().data) for message in bag] == [noise]


def test_a_name_that_is_none_of_a_type(tmp_path):
    with (
        BagWriter(tmp_path / "made") as writer,
        pytest.raises(BagError, match="'foo' is not the name of a message type"),
    ):
        writer.add_topic("/q", "foo")


def test_a_message_object_adds_its_topic(tmp_path):
    text = msg.get_message("std_msgs/msg/String")
    with BagWriter(tmp_path / "made") as writer:
        writer.write("/chatter", text(data="a"), 5)
        writer.write("/chatter", msg.serialize(text(data="b")), 6)
        with pytest.raises(TypeError):
            writer.write("/chatter", msg.get_message("std_msgs/msg/Header")(), 7)
    with pytest.raises(BagError, match="closed"):
        writer.write("/other", text(data="c"), 8)
    with open_bag(tmp_path / "made") as bag:
        assert bag.topics["/chatter"].type == "std_msgs/msg/String"
        assert [message.decode().data for message in bag.messages("/chatter")] == ["a", "b"]


@pytest.mark.parametrize("topic", ["/tf", "/tf_static", "/robot1/tf", "tf"])
def test_topics_of_transforms_begin_with_their_type(tmp_path, topic):
    """A bag with other messages there has no TF for any reader."""
    sample = msg.get_message("geometry_msgs/msg/TransformStamped")()
    whole = msg.get_message("tf2_msgs/msg/TFMessage")(transforms=[sample])
    with BagWriter(tmp_path / "made") as writer:
        with pytest.raises(TypeError) as caught:
            writer.write(topic, sample, log_time_ns=1)
        assert str(caught.value) == (
            f"{topic} carries tf2_msgs/msg/TFMessage, not geometry_msgs/msg/TransformStamped; put "
            "it into TFMessage(transforms=[...])"
        )
        assert writer.topics == {}
        writer.write(topic, whole, log_time_ns=1)
        writer.write("/pose_of_tf", sample, log_time_ns=1)


def test_a_type_that_is_added_on_purpose(tmp_path):
    sample = msg.get_message("geometry_msgs/msg/TransformStamped")()
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "geometry_msgs/msg/TransformStamped")
        writer.write("/tf", sample, log_time_ns=1)
    with open_bag(tmp_path / "made") as bag:
        assert bag.topics["/tf"].type == "geometry_msgs/msg/TransformStamped"


def test_message_and_topic_in_the_wrong_order(tmp_path):
    sample = msg.get_message("geometry_msgs/msg/TransformStamped")()
    with (
        BagWriter(tmp_path / "made") as writer,
        pytest.raises(TypeError, match="topic must be str, not TransformStamped"),
    ):
        writer.write(sample, "/pose", log_time_ns=1)


def test_data_that_is_no_message(tmp_path):
    sample = msg.get_message("geometry_msgs/msg/TransformStamped")()
    with BagWriter(tmp_path / "made") as writer:
        with pytest.raises(TypeError, match="/tf accepts a message or its CDR bytes, not list"):
            writer.write("/tf", [sample], log_time_ns=1)
        with pytest.raises(TypeError, match="the name of a type must be str, not type"):
            writer.add_topic("/pose", type(sample))


@pytest.mark.parametrize(
    ("folder", "names"),
    [
        ("ride", ["0_ride_T.mcap", "1_ride_T.mcap"]),
        ("rosbag2_2026_05_01-10_11_12", ["0_rosbag2_T.mcap", "1_rosbag2_T.mcap"]),
    ],
)
def test_files_of_lyrical_have_the_number_in_front_and_the_time_behind(tmp_path, folder, names):
    path = tmp_path / folder
    with BagWriter(path, max_file_ns=1, ros_distro="lyrical") as writer:
        for stamp in (START, START + 10):
            writer.write("/chatter", msg.get_message("std_msgs/msg/String")(data="x"), stamp)
    times = r"_\d{4}(_\d\d){2}-\d\d(_\d\d){2}\.mcap"
    assert [re.sub(times, "_T.mcap", name) for name in writer.metadata.paths] == names
    (path / "metadata.yaml").unlink()
    with open_bag(path) as bag:  # the order is that of the numbers
        assert bag.metadata.paths == writer.metadata.paths
        assert [message.log_time_ns for message in bag] == [START, START + 10]


@pytest.mark.parametrize(
    "end", ["", "writer = None", "writer.close(); del writer", "raise SystemExit(0)"]
)
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_is_finished_when_the_program_forgets_to_close_it(tmp_path, storage, end):
    program = f"""
from turtlewire.bag import BagWriter
from turtlewire.msg import get_message
writer = BagWriter("out", storage="{storage}")
writer.write("/a", get_message("std_msgs/msg/String")(data="x"), log_time_ns=1)
{end}
"""
    subprocess.run([sys.executable, "-c", program], check=True, cwd=tmp_path)
    assert (tmp_path / "out" / "metadata.yaml").exists()
    with open_bag(tmp_path / "out") as bag:
        assert len(bag) == len(list(bag)) == 1


def test_an_oldest_file_that_was_moved_away_is_no_error(tmp_path):
    with BagWriter(tmp_path / "made", max_files=2) as writer:
        for time in range(4):
            writer.write("/a", msg.get_message("std_msgs/msg/String")(), time)
            _, current = writer.split()
            if time == 0:
                os.rename(tmp_path / "made" / "made_0.mcap", tmp_path / "kept.mcap")
    names = {path.name for path in (tmp_path / "made").iterdir()}
    assert names == {"made_3.mcap", os.path.basename(current), "metadata.yaml"}
    with open_bag(tmp_path / "made") as bag:
        assert [message.log_time_ns for message in bag] == [3]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="Windows has no fork()")
def test_a_fork_does_not_finish_the_bag_of_its_parent(tmp_path):
    program = """
import os, sys, warnings
from turtlewire.bag import BagWriter
from turtlewire.msg import get_message
String = get_message("std_msgs/msg/String")
warnings.simplefilter("ignore")
writer = BagWriter("out")
writer.write("/a", String(data="before"), log_time_ns=1)
if os.fork() == 0:
    sys.exit(0)
os.wait()
writer.write("/a", String(data="behind"), log_time_ns=2)
"""
    subprocess.run([sys.executable, "-c", program], check=True, cwd=tmp_path)
    with open_bag(tmp_path / "out") as bag:
        assert [message.log_time_ns for message in bag] == [1, 2]
