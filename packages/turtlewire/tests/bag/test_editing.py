"""Parts of bags, merged bags and pieces hold the messages that they should hold."""

import os
import random
import shutil
import sys

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader
from tests.bags import SECOND, START, transform, write_bag

from turtlewire import msg
from turtlewire.bag import BagWriter, copy_bag, merge_bags, open_bag, split_bag
from turtlewire.bag.copying import ChunkCopy
from turtlewire.bag.mcap_reader import McapFile
from turtlewire.bag.output_channels import OutputChannels, Selection
from turtlewire.bag.pieces import Pieces
from turtlewire.errors import BagError
from turtlewire.wire.qos import Durability, History, QoS

from .conftest import GOLDEN

String = msg.get_message("std_msgs/msg/String")
LATCHED = QoS(depth=2, durability=Durability.TRANSIENT_LOCAL)
WAYS = {
    "mcap": {"chunk_bytes": 1000},
    "zstd": {"compression": "zstd", "chunk_bytes": 1000},
    "split": {"max_file_bytes": 3000, "chunk_bytes": 1000},
    "file": {"compression_mode": "FILE", "chunk_bytes": 1000},
    "sqlite3": {"storage": "sqlite3"},
    "message": {"storage": "sqlite3", "compression_mode": "MESSAGE"},
}


def everything(path):
    with open_bag(path) as bag:
        found = [tuple(message) for message in bag]
        assert bag.problems == []
    return found


def text_bag(path, stamps, topic="/a", words="x", **options):
    with BagWriter(path, **options) as writer:
        writer.add_topic(topic, "std_msgs/msg/String")
        for number, stamp in enumerate(stamps):
            writer.write(topic, String(data=f"{words} {number}"), stamp)
    return path


def judged(folder):
    """The messages as two other libraries read them."""
    with AnyReader([folder]) as reader:
        found = [(c.topic, stamp, bytes(data)) for c, stamp, data in reader.messages()]
    for file in folder.glob("*.mcap"):
        with file.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True)
            assert reader.get_summary().statistics.message_count == len(found)
            others = [(c.topic, m.log_time, m.data) for _, c, m in reader.iter_messages()]
        assert others == found
    return found


# -- round trips

MESSAGES = st.lists(
    st.tuples(st.integers(1, 60), st.sampled_from("abc"), st.integers(0, 40)),
    min_size=1,
    max_size=40,
)


def random_bag(path, messages, **options):
    with BagWriter(path, **options) as writer:
        for topic in "abc":
            writer.add_topic(f"/{topic}", "std_msgs/msg/String")
        for number, (stamp, topic, size) in enumerate(messages):
            data = String(data=f"{number}" + "x" * size)
            writer.write(f"/{topic}", data, stamp, stamp + number)
    return path


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    messages=MESSAGES,
    at=st.integers(2, 60),
    chunk=st.sampled_from([1, 100, 300, 10_000]),
    options=st.sampled_from([{}, {"compression": "zstd"}, {"max_file_bytes": 400}]),
)
def test_cut_then_merged_is_the_original(tmp_path_factory, messages, at, chunk, options):
    folder = tmp_path_factory.mktemp("cut")
    source = random_bag(folder / "in", messages, chunk_bytes=chunk, **options)
    parts = []
    for name, window in (("early", {"end": at}), ("late", {"start": at})):
        try:
            parts += copy_bag(source, folder / name, **window).paths
        except BagError:
            assert not (folder / name).exists()
            stamps = [stamp for stamp, _, _ in messages]
            assert all(stamp >= at for stamp in stamps) or all(stamp < at for stamp in stamps)
    merge_bags(parts, folder / "out")
    assert everything(folder / "out") == everything(source)
    shutil.rmtree(folder)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    messages=MESSAGES,
    how=st.sampled_from([{"every": 7}, {"size": 500}, {"at": [20, 21, 40]}]),
    chunk=st.sampled_from([1, 100, 300, 10_000]),
    storage=st.sampled_from(["mcap", "sqlite3"]),
)
def test_split_then_merged_is_the_original(tmp_path_factory, messages, how, chunk, storage):
    folder = tmp_path_factory.mktemp("split")
    if (
        "size" in how
    ):  # pieces of one size may overlap in time, so that equal times lose their order
        messages = sorted(messages)
    options = {"chunk_bytes": chunk} if storage == "mcap" else {"storage": storage}
    source = random_bag(folder / "in", messages, **options)
    parts = split_bag(source, folder / "parts", **how).paths
    assert parts == [str(folder / "parts" / f"parts_{n}") for n in range(len(parts))]
    assert all(everything(part) for part in parts)
    merge_bags(parts, folder / "out")
    assert everything(folder / "out") == everything(source)
    shutil.rmtree(folder)


@pytest.mark.parametrize(
    ("at", "sizes"), [(20, [2, 1]), ([30, 20], [2, 0, 1]), ((t for t in (20, 21)), [2, 1])]
)
def test_a_bag_is_split_at_one_time_or_any_number_of_them(tmp_path, at, sizes):
    source = random_bag(tmp_path / "in", [(1, "a", 0), (19, "a", 0), (30, "a", 0)])
    parts = split_bag(source, tmp_path / "out", at=at).paths
    assert [len(everything(part)) for part in parts] == [size for size in sizes if size]


@pytest.mark.parametrize(
    ("cuts", "text"),
    [
        ({"size": 0}, "size must be positive, got 0"),
        ({"every": 0}, "every must be positive, got 0"),
        ({"every": 1}, "every=1 makes 10,001 bags, more than 10,000"),
    ],
)
def test_pieces_are_positive_and_not_too_many(tmp_path, cuts, text):
    source = random_bag(tmp_path / "in", [(1, "a", 0), (10_001, "a", 0)])
    with pytest.raises(BagError, match=text):
        split_bag(source, tmp_path / "out", **cuts)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_each_way_is_read_by_others(tmp_path, way, storage):
    source = write_bag(tmp_path / "in", **WAYS[way])
    copy_bag(source, tmp_path / "out", start="100ms", end="700ms", storage=storage)
    expected = [
        message
        for message in everything(source)
        if START + SECOND // 10 <= message[2] < START + 7 * SECOND // 10
    ]
    found = everything(tmp_path / "out")
    compared = slice(0, 5) if "sqlite3" not in (storage, WAYS[way].get("storage")) else slice(0, 3)
    assert [each[compared] for each in found] == [each[compared] for each in expected]
    if way not in ("file", "message", "zstd") or (storage == "mcap" and way == "zstd"):
        assert judged(tmp_path / "out") == [(m[0], m[2], m[4]) for m in expected]
    with open_bag(source) as before, open_bag(tmp_path / "out") as after:
        for name, topic in after.topics.items():
            assert topic.qos == before.topics[name].qos
            assert topic.type_hash == before.topics[name].type_hash
            assert topic.type_hash
        assert after.definitions() == before.definitions()


@pytest.mark.parametrize(
    "name", sorted(each.name for each in (GOLDEN).glob("d_*") if each.is_dir())
)
def test_a_whole_real_bag_is_copied(tmp_path, name):
    copy_bag(GOLDEN / name, tmp_path / "out")
    assert everything(tmp_path / "out") == everything(GOLDEN / name)
    with open_bag(GOLDEN / name) as before, open_bag(tmp_path / "out") as after:
        assert {t.name: t.qos for t in after.metadata.topics if t.message_count} == {
            t.name: t.qos for t in before.metadata.topics if t.message_count
        }
        assert after.metadata.ros_distro == before.metadata.ros_distro
        assert after.metadata.custom_data == before.metadata.custom_data


# -- the bounds


def test_the_start_is_included_and_the_end_is_not(tmp_path):
    source = text_bag(tmp_path / "in", [START, START + 10, START + 20])
    copy_bag(source, tmp_path / "out", start=START + 10, end=START + 20)
    assert [each[2] for each in everything(tmp_path / "out")] == [START + 10]
    copy_bag(source, tmp_path / "more", start=START + 9, end=START + 21)
    assert [each[2] for each in everything(tmp_path / "more")] == [START + 10, START + 20]


def test_chunks_inside_the_selection_are_copied_as_bytes(tmp_path, monkeypatch):
    source = write_bag(tmp_path / "in", chunk_bytes=1000, compression="zstd")
    read = []
    original = McapFile.records
    monkeypatch.setattr(
        McapFile, "records", lambda file, chunk: read.append(chunk.offset) or original(file, chunk)
    )
    copy_bag(source, tmp_path / "all")
    assert read == []
    copy_bag(source, tmp_path / "part", start="205ms", end="705ms")
    assert 1 <= len(read) <= 2
    assert judged(tmp_path / "part") == [
        (m[0], m[2], m[4])
        for m in everything(source)
        if START + 205_000_000 <= m[2] < START + 705_000_000
    ]


def test_copied_chunks_define_only_selected_topics(tmp_path):
    with BagWriter(tmp_path / "in", chunk_bytes=1) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        writer.add_topic("/secret", "std_msgs/msg/Bool")
        for number in range(3):
            writer.write("/a", String(data="x"), START + number)
    copy_bag(tmp_path / "in", tmp_path / "out", topics="/a")
    assert b"/secret" not in (tmp_path / "out" / "out_0.mcap").read_bytes()
    assert len(judged(tmp_path / "out")) == 3


# -- topics


def test_topics_types_and_names(tmp_path):
    source = write_bag(tmp_path / "in")
    for options, expected in (
        ({"topics": "/tf*"}, {"/tf", "/tf_static"}),
        ({"topics": ["/tf", "/chatter"]}, {"/tf", "/chatter"}),
        ({"exclude": "/tf"}, {"/tf_static", "/chatter"}),
        ({"types": "std_msgs/String"}, {"/chatter"}),
        ({"types": "tf2_msgs/*", "exclude": ["/tf_static"]}, {"/tf"}),
        ({"rename_topics": {"/tf": "/r1/tf"}, "topics": "/tf"}, {"/r1/tf"}),
    ):
        target = tmp_path / f"out{len(list(tmp_path.iterdir()))}"
        copy_bag(source, target, **options)
        with open_bag(target) as bag:
            assert set(bag.topics) == expected
            assert {message.topic for message in bag} == expected
        judged(target)


@pytest.mark.parametrize(
    ("options", "text", "hint"),
    [
        ({"topics": "/chater"}, "there is no topic '/chater'", "Did you mean: /chatter"),
        ({"exclude": "/x*"}, "there is no topic '/x*'", "There are the topics /chatter, /tf"),
        ({"types": "std_msgs/msg/Strin"}, "there is no type", "Did you mean: std_msgs/msg/String"),
        ({"topics": "/tf", "exclude": "/tf"}, "the selection has no topic", "There are the topics"),
        ({"rename_topics": {"/tff": "/x"}}, "there is no topic '/tff'", "Did you mean: /tf"),
        ({"rename_topics": {"/tf": "x y"}}, "'x y' is not the name of a topic", ""),
        ({"rename_frames": {"odm": "x"}}, "no message has the frame 'odm'", "Did you mean: odom"),
        ({"rename_frames": {"odom": "/x"}}, "begins with a slash", ""),
        ({"rename_frames": {"odom": ""}}, "the name of a frame must not be empty: odom:=", ""),
        ({"rename_frames": {"": "x"}}, "the name of a frame must not be empty: :=x", ""),
        ({"start": "10"}, "'10' has no unit: write 10s", ""),
        ({"start": "tomorrow"}, "'tomorrow' is not a time", ""),
        ({"start": "2s", "end": "1s"}, "is not after the start", ""),
        ({"start": "5s"}, "in has messages from 20", ""),
        ({"compression": "zst"}, "unknown compression 'zst'", "Did you mean: zstd"),
        ({"storage": "sqlite"}, "unknown storage 'sqlite'", "Use 'mcap' or 'sqlite3'"),
    ],
)
def test_mistakes_leave_nothing(tmp_path, options, text, hint):
    source = write_bag(tmp_path / "in", count=20)
    with pytest.raises(BagError) as error:
        copy_bag(source, tmp_path / "out", **options)
    assert text in str(error.value)
    assert hint in error.value.hint
    assert [each.name for each in tmp_path.iterdir()] == ["in"]


def test_an_existing_output_is_kept(tmp_path):
    source = write_bag(tmp_path / "in", count=2)
    (tmp_path / "out").mkdir()
    with pytest.raises(FileExistsError, match="needs a new folder"):
        copy_bag(source, tmp_path / "out")
    with pytest.raises(FileExistsError):
        copy_bag(source, source)
    assert list((tmp_path / "out").iterdir()) == []
    assert len(everything(source)) == 3


def test_unknown_options_are_type_errors(tmp_path):
    source = write_bag(tmp_path / "in", count=2)
    with pytest.raises(TypeError, match=r"there is no option 'topic'\. Did you mean: topics"):
        copy_bag(source, tmp_path / "out", topic="/tf")
    with pytest.raises(TypeError, match="one of every=, size= and at="):
        split_bag(source, tmp_path / "out", every="1s", size=100)


# -- frames


def test_frames_are_renamed(tmp_path):
    source = write_bag(tmp_path / "in", count=30)
    copy_bag(source, tmp_path / "out", rename_frames={"odom": "r1/odom", "base_link": "odom"})
    for before, after in zip(everything(source), everything(tmp_path / "out"), strict=True):
        assert before[:4] == after[:4]
        if before[0] == "/chatter":
            assert before[4] == after[4]
            continue
        old = msg.deserialize("tf2_msgs/msg/TFMessage", before[4])
        new = msg.deserialize("tf2_msgs/msg/TFMessage", after[4])
        names = {"odom": "r1/odom", "base_link": "odom"}
        for each in old.transforms:
            each.header.frame_id = names.get(each.header.frame_id, each.header.frame_id)
            each.child_frame_id = names.get(each.child_frame_id, each.child_frame_id)
        assert new == old


def test_frames_are_renamed_by_the_definition_in_the_bag(tmp_path):
    text = "std_msgs/Header header\nuint8 level\nfloat64 value\nstring note\n"
    separator = "=" * 80
    header = f"{separator}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    stamp = f"{separator}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
    definition = ("ros2msg", text + header + stamp)
    # frame 'odom', level 7, value 1.5, note 'odom'
    body = bytes(8) + b"\5\0\0\0odom\0" + b"\7" + bytes(6) + b"\0\0\0\0\0\0\xf8\x3f"
    data = b"\0\1\0\0" + body + b"\5\0\0\0odom\0"
    with BagWriter(tmp_path / "in") as writer:
        writer.add_topic("/x", "edited_msgs/msg/Level", definition=definition, hash_of_type="")
        writer.write("/x", data, START)
    copy_bag(tmp_path / "in", tmp_path / "out", rename_frames={"odom": "robot1/odom"})
    with open_bag(tmp_path / "out") as bag:
        (message,) = bag
        assert bag.definitions()["edited_msgs/msg/Level"] == definition
        level = message.decode()
    assert (level.header.frame_id, level.level, level.value) == ("robot1/odom", 7, 1.5)
    assert level.note == "odom"  # it is not a frame


def test_frames_that_cannot_be_renamed_are_reported(tmp_path):
    with BagWriter(tmp_path / "in") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.add_topic("/x", "no_msgs/msg/X", definition=("ros2msg", ""), hash_of_type="")
        writer.write("/tf", transform(0), START)
        writer.write("/x", b"\0\1\0\0\5\0\0\0odom\0", START)
    done = copy_bag(tmp_path / "in", tmp_path / "out", rename_frames={"odom": "o"})
    assert done.messages == 2
    (problem,) = done.problems
    assert problem.startswith("/x: its frames are not renamed: ")


# -- latched messages


def latched_bag(path, **options):
    """Two static transforms and three latched texts before START + 1 s, texts after it."""
    with BagWriter(path, **options) as writer:
        writer.add_topic("/tf_static", "tf2_msgs/msg/TFMessage")
        writer.add_topic("/map", "std_msgs/msg/String", qos=[LATCHED])
        writer.add_topic("/tick", "std_msgs/msg/String")
        for number, (parent, child) in enumerate((("a", "b"), ("a", "c"), ("z", "b"))):
            writer.write("/tf_static", transform(0, parent, child), START + number, START - SECOND)
        for number in range(3):
            writer.write("/map", String(data=f"map {number}"), START + 10 + number)
        for number in range(40):
            writer.write("/tick", String(data=f"{number}"), START + number * SECOND // 10 + 20)
    return path


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_latched_messages_are_repeated_at_the_start(tmp_path, storage):
    options = {"storage": storage} if storage == "sqlite3" else {"chunk_bytes": 300}
    source = latched_bag(tmp_path / "in", **options)
    copy_bag(source, tmp_path / "out", start="1s", end="2s", tf_at_start=True)
    with open_bag(tmp_path / "out") as bag:
        first, second, static, *ticks = bag
        assert [each.decode().data for each in (first, second)] == ["map 1", "map 2"]
        links = {(t.header.frame_id, t.child_frame_id) for t in static.decode().transforms}
        assert links == {("z", "b"), ("a", "c")}
        assert {each.log_time_ns for each in (first, second, static)} == {START + SECOND}
        if storage == "mcap":
            assert static.publish_time_ns == START - SECOND
        assert [each.decode().data for each in ticks] == [str(n) for n in range(10, 20)]
        assert bag.start_ns == START + SECOND
    judged(tmp_path / "out")


@pytest.mark.parametrize("how", [{"every": "1s"}, {"size": 1500}, {"at": ["500ms", "1.5s"]}])
def test_each_piece_begins_with_the_latched_messages(tmp_path, how):
    source = latched_bag(tmp_path / "in", chunk_bytes=300)
    done = split_bag(source, tmp_path / "out", tf_at_start=True, **how)
    assert len(done.paths) > 2
    assert done.messages == len(everything(source))
    late = [path for path in done.paths if everything(path)[0][2] >= START + SECOND // 2]
    assert len(late) > 1
    for path in late:
        topics = [message[0] for message in everything(path)]
        assert topics[:3] == ["/map", "/map", "/tf_static"]
        assert set(topics[3:]) == {"/tick"}


def test_a_compression_whose_package_is_missing(tmp_path, monkeypatch):
    text_bag(tmp_path / "in", [START])
    monkeypatch.setitem(sys.modules, "lz4.frame", None)
    with pytest.raises(BagError, match=r"^lz4 needs the package 'lz4', which is missing"):
        copy_bag(tmp_path / "in", tmp_path / "out", compression="lz4")
    assert not (tmp_path / "out").exists()


def test_a_name_that_is_not_utf_8_is_refused(tmp_path):
    text_bag(tmp_path / "in", [START])
    with pytest.raises(BagError, match=r"^the name 'l\\udce9' is not UTF-8"):
        copy_bag(tmp_path / "in", tmp_path / "l\udce9")


@pytest.mark.parametrize("compression", ["none", "zstd"])
def test_pieces_have_about_the_size(tmp_path, compression):
    with BagWriter(tmp_path / "in", chunk_bytes=5000) as writer:
        for number in range(300):
            data = String(data=random.Random(number).randbytes(500).hex())
            writer.write("/a", data, START + number)
    done = split_bag(tmp_path / "in", tmp_path / "out", size="60kB", compression=compression)
    sizes = [os.path.getsize(f"{path}/{os.path.basename(path)}_0.mcap") for path in done.paths]
    assert len(sizes) > 2
    assert max(sizes) < 63_000
    if compression == "none":  # of chunks to come, the size before compression counts
        assert min(sizes[:-1]) > 52_000


def test_a_chunk_that_is_larger_than_a_piece_is_divided(tmp_path):
    source = text_bag(tmp_path / "in", range(START, START + 300))
    done = split_bag(source, tmp_path / "out", size="4kB")
    assert len(done.paths) > 2
    assert done.messages == 300
    assert [each for path in done.paths for each in everything(path)] == everything(source)


def test_pieces_of_a_size_are_not_too_many(tmp_path, monkeypatch):
    monkeypatch.setattr("turtlewire.bag.pieces.MOST_PIECES", 3)
    source = text_bag(tmp_path / "in", range(START, START + 4))
    with pytest.raises(BagError, match=r"^this makes more than 3 bags$"):
        split_bag(source, tmp_path / "out", size=1)
    assert not (tmp_path / "out").exists()


def test_sqlite3_refuses_lz4(tmp_path):
    source = text_bag(tmp_path / "in", [START])
    with pytest.raises(BagError, match=r"^sqlite3 files compress messages with zstd, not with lz4"):
        copy_bag(source, tmp_path / "out", storage="sqlite3", compression="lz4")


@pytest.mark.parametrize(("size", "counts"), [(29, [1, 1, 1, 1]), (30, [2, 2]), (44, [2, 2])])
def test_a_message_that_just_fits_belongs_to_the_piece(tmp_path, size, counts):
    # Of a database, the bytes of the messages count.
    with BagWriter(tmp_path / "in", storage="sqlite3") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for number in range(4):
            writer.write("/a", bytes(15), START + number)
    done = split_bag(tmp_path / "in", tmp_path / "out", size=size)
    assert [len(everything(path)) for path in done.paths] == counts


def test_the_first_piece_repeats_nothing(tmp_path):
    source = latched_bag(tmp_path / "in")
    copy_bag(source, tmp_path / "out", tf_at_start=True)
    assert everything(tmp_path / "out") == everything(source)


def test_topics_that_are_left_out_are_not_repeated(tmp_path):
    source = latched_bag(tmp_path / "in")
    copy_bag(source, tmp_path / "out", start="1s", exclude="/map", tf_at_start=True)
    assert {message[0] for message in everything(tmp_path / "out")} == {"/tf_static", "/tick"}


def test_publishers_that_keep_all_repeat_all(tmp_path):
    keep_all = QoS(history=History.KEEP_ALL, durability=Durability.TRANSIENT_LOCAL)
    with BagWriter(tmp_path / "in") as writer:
        writer.add_topic("/log", "std_msgs/msg/String", qos=[keep_all])
        for number in range(20):
            writer.write("/log", String(data=f"{number}"), START + number)
    copy_bag(tmp_path / "in", tmp_path / "out", start=START + 15, tf_at_start=True)
    assert len(everything(tmp_path / "out")) == 20


# -- merging


def test_bags_are_merged_in_order_of_time(tmp_path):
    one = text_bag(tmp_path / "one", range(START, START + 100, 2), "/a", chunk_bytes=200)
    two = text_bag(tmp_path / "two", range(START + 1, START + 301, 2), "/b", chunk_bytes=200)
    done = merge_bags([one, two], tmp_path / "out")
    assert done.messages == 200
    found = judged(tmp_path / "out")
    assert [each[1] for each in found] == sorted(each[1] for each in found)
    file = McapFile(str(tmp_path / "out" / "out_0.mcap"))
    times = [each[0] for chunk in file.chunks for each in file.messages(chunk)]
    file.close()
    assert times == sorted(times)  # `ros2 bag play` of Jazzy reads in the order of the file


def test_a_topic_of_two_types_names_both_bags(tmp_path):
    one = text_bag(tmp_path / "one", [START])
    with BagWriter(tmp_path / "two") as writer:
        writer.add_topic("/a", "std_msgs/msg/Bool")
        writer.write("/a", b"\0\1\0\0\1", START)
    with pytest.raises(BagError) as error:
        merge_bags([one, tmp_path / "two"], tmp_path / "out")
    for word in ("/a is of type std_msgs/msg/String", "std_msgs/msg/Bool", str(one), "/two"):
        assert word in str(error.value)
    assert not (tmp_path / "out").exists()


def test_two_definitions_of_a_type_are_kept_apart(tmp_path):
    paths = []
    for number, text in enumerate(("string data\n", "# changed\nstring data\n")):
        paths.append(tmp_path / f"in{number}")
        with BagWriter(paths[-1]) as writer:
            writer.add_topic("/a", "std_msgs/msg/String", definition=("ros2msg", text))
            writer.write("/a", String(data=text), START + number)
    merge_bags(paths, tmp_path / "out")
    with (tmp_path / "out" / "out_0.mcap").open("rb") as stream:
        found = [
            (schema.data.decode(), message.data[8:-1].decode())
            for schema, _, message in make_reader(stream, validate_crcs=True).iter_messages()
        ]
    assert [schema == data for schema, data in found] == [True, True]
    with open_bag(tmp_path / "out") as bag:
        assert bag.topics["/a"].message_count == 2
        assert bag.metadata.message_count == 2
        assert [message.decode().data for message in bag] == [text for text, _ in found]
    copy_bag(tmp_path / "out", tmp_path / "again", start=START + 1)
    assert judged(tmp_path / "again") == judged(tmp_path / "out")[1:]
    with pytest.raises(BagError, match=r"defined differently in .*in0 and .*in1") as error:
        merge_bags(paths, tmp_path / "db", storage="sqlite3")
    assert "MCAP" in error.value.hint


def test_mixed_storages_are_merged(tmp_path):
    one = text_bag(tmp_path / "one", [START, START + 5], storage="sqlite3")
    two = text_bag(tmp_path / "two", [START + 1], compression="zstd")
    merge_bags([one, two], tmp_path / "out")
    with open_bag(tmp_path / "out") as bag:
        assert bag.metadata.storage == "sqlite3"
        assert [each.log_time_ns - START for each in bag] == [0, 1, 5]
    merge_bags([one, two], tmp_path / "mcap", storage="mcap", compression="zstd")
    assert judged(tmp_path / "mcap") == judged(tmp_path / "out")


def test_publishers_of_both_bags_are_kept(tmp_path):
    for name, depth in (("one", 1), ("two", 2)):
        with BagWriter(tmp_path / name) as writer:
            writer.add_topic("/a", "std_msgs/msg/String", qos=[QoS(depth=depth)])
            writer.write("/a", String(data="x"), START + depth)
    merge_bags([tmp_path / "one", tmp_path / "two"], tmp_path / "out")
    os.remove(tmp_path / "out" / "metadata.yaml")
    with open_bag(tmp_path / "out") as bag:
        assert [qos.depth for qos in bag.topics["/a"].qos] == [1, 2]


# -- damage and failure


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_cut_off_bag_is_copied_as_far_as_it_goes(tmp_path, storage):
    source = tmp_path / "in"
    options = {"storage": storage} if storage == "sqlite3" else {"chunk_bytes": 2000}
    text_bag(source, range(START, START + 1000), words="x" * 60, **options)
    os.remove(source / "metadata.yaml")
    (file,) = source.iterdir()
    file.write_bytes(file.read_bytes()[: file.stat().st_size * 2 // 3])
    done = copy_bag(source, tmp_path / "out")
    assert 10 < done.messages < 1000
    assert str(file) in done.problems[0]
    assert [each[1] for each in judged(tmp_path / "out")] == [
        START + number for number in range(done.messages)
    ]


def test_a_damaged_chunk_is_reported(tmp_path):
    source = text_bag(tmp_path / "in", range(START, START + 300), chunk_bytes=2000)
    file = source / "in_0.mcap"
    data = bytearray(file.read_bytes())
    data[len(data) // 4 : len(data) // 4 + 200] = bytes(200)
    file.write_bytes(data)
    done = copy_bag(source, tmp_path / "out")
    assert any("damaged" in problem for problem in done.problems)
    assert 100 < done.messages < 300
    assert len(judged(tmp_path / "out")) == done.messages


def test_a_missing_file_of_a_bag_is_reported(tmp_path):
    source = text_bag(
        tmp_path / "in", range(START, START + 300), max_file_bytes=3000, chunk_bytes=500
    )
    (source / "in_1.mcap").unlink()
    done = copy_bag(source, tmp_path / "out")
    assert "in_1.mcap" in " ".join(done.problems)
    assert 100 < done.messages < 300


@pytest.mark.parametrize("way", ["mcap", "zstd", "sqlite3"])
def test_mutated_bags_are_copied_or_refused(tmp_path, way):
    source = write_bag(tmp_path / "in", count=60, **WAYS[way])
    other = text_bag(tmp_path / "other", [START, START + SECOND])
    (file,) = [each for each in source.iterdir() if each.name != "metadata.yaml"]
    whole, generator = file.read_bytes(), random.Random(way)
    target, written = tmp_path / "out", 0
    for _ in range(25):
        data = bytearray(whole)
        for _ in range(generator.randint(1, 5)):
            at = generator.randrange(len(data))
            if generator.random() < 0.2:
                del data[at : at + generator.randint(1, 400)]
            else:
                data[at : at + 1] = generator.randbytes(1)
        file.write_bytes(data)
        for write in (
            lambda: copy_bag(source, target, start="100ms", tf_at_start=True),
            lambda: copy_bag(source, target, rename_frames={"odom": "o"}),
            lambda: split_bag(source, target, every="200ms"),
            lambda: merge_bags([source, other], target),
        ):
            try:
                paths = write().paths
            except BagError:
                assert not target.exists()
                continue
            written += len(paths)
            for path in paths:
                with open_bag(path) as bag:
                    assert len(bag)
            shutil.rmtree(target)
    assert written > 50


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_full_disk_leaves_nothing(tmp_path, monkeypatch, storage):
    source = write_bag(tmp_path / "in", storage=storage)

    def full(*_args):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("turtlewire.bag.mcap_writer.McapWriter.flush", full)
    monkeypatch.setattr("turtlewire.bag.sqlite_writer.SqliteWriter.flush", full)
    with pytest.raises(OSError, match="No space left") as error:
        copy_bag(source, tmp_path / "out")
    assert error.value.filename == str(tmp_path / "out")
    assert [each.name for each in tmp_path.iterdir()] == ["in"]


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_an_interrupted_operation_leaves_nothing(tmp_path, share):
    source = write_bag(tmp_path / "in", chunk_bytes=500)

    def interrupt(done):
        if done >= share:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        split_bag(source, tmp_path / "out", every="300ms", progress=interrupt)
    assert [each.name for each in tmp_path.iterdir()] == ["in"]


def test_a_part_is_read_with_little_memory(tmp_path):
    import tracemalloc

    with BagWriter(tmp_path / "in", chunk_bytes=100_000) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for number in range(400):
            writer.write("/a", String(data="x" * 50_000), START + number)
    for name, options in (("raw", {}), ("read", {"compression": "zstd"})):
        tracemalloc.start()
        try:
            copy_bag(tmp_path / "in", tmp_path / name, **options)
            _, most = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        assert most < 4_000_000, name  # of 20 MB


@pytest.mark.parametrize("end_ns", [START + 5, START + 100], ids=["messages", "chunks"])
def test_an_error_of_the_new_bag_is_not_damage_of_the_old_one(tmp_path, end_ns):
    damage = []
    with open_bag(text_bag(tmp_path / "in", range(START, START + 10))) as bag:
        selection = Selection()
        channels = OutputChannels([bag], selection, "mcap")
        copy = ChunkCopy([bag], selection.takes, channels, None, damage.append)
        pieces = Pieces(str(tmp_path / "out"), channels, {})
        pieces.writer(START, 0).close()
        with pytest.raises(BagError, match="is closed"):
            copy.copy(pieces, START, end_ns, lambda share: None)
    assert damage == []
