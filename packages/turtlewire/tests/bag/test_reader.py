"""Choosing messages by topic, type and time; bags that are not there or are something else."""

import os
import re
import shutil
from xml.etree import ElementTree as ET

import pytest
from tests.bags import SECOND, START, contents, transform, write_bag

from turtlewire import Buffer, msg
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.metadata import BagMetadata, TopicInfo
from turtlewire.errors import BagError, InterfaceError


@pytest.mark.parametrize(
    ("definition", "reason"),
    [
        ("int32", "bag_only/msg/Broken, line 1: '' is not a name in 'int32'"),
        ("Broken[] inner", "bag_only/msg/Broken contains itself"),
        (
            f"Other x\n{'=' * 80}\nMSG: bag_only/Other\nBroken y",
            "bag_only/msg/Broken contains itself",
        ),
        (f"Other x\n{'=' * 80}\nMSG: bag_only/Other\nNothing y", "bag_only/msg/Nothing"),
    ],
)
def test_a_definition_that_cannot_be_read_is_named(tmp_path, definition, reason):
    with BagWriter(tmp_path / "own") as writer:
        writer.add_topic("/own", "bag_only/msg/Broken", definition=("ros2msg", definition))
        writer.write("/own", bytes(8), 1)
    with open_bag(tmp_path / "own") as bag:
        (message,) = bag
        assert "own_0.mcap: the definition of bag_only/msg/Broken: " in bag.problems[0]
        assert reason in bag.problems[0]
        with pytest.raises(InterfaceError):
            message.decode()


def test_topics_types_and_times(bag_path):
    with open_bag(bag_path) as bag:
        everything = list(bag.messages())
        assert len(everything) == len(bag) == 111
        one = [m for m in everything if m.topic == "/chatter"]
        assert list(bag.messages("/chatter")) == list(bag.messages(["/chatter"])) == one
        assert [m.decode().data for m in one] == [f"number {i}" for i in range(9, 100, 10)]
        both = [m for m in everything if m.topic in {"/tf", "/tf_static"}]
        assert list(bag.messages(types="tf2_msgs/msg/TFMessage")) == both
        start, end = START + SECOND // 4, START + SECOND // 2
        window = [m for m in everything if start <= m.log_time_ns <= end]
        assert 20 < len(window) < 40
        assert list(bag.messages(start_ns=start, end_ns=end)) == window


@pytest.mark.parametrize(
    "options",
    [
        {"chunk_bytes": 60},
        {"chunk_bytes": 60, "compression": "zstd"},
        {"storage": "sqlite3"},
        {"max_file_bytes": 400},
    ],
)
def test_both_ends_of_a_window_belong_to_it(tmp_path, options):
    """The ends of chunks and files included: each message begins, and ends, some window."""
    with BagWriter(tmp_path / "made", **options) as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for time in range(100, 160, 2):
            writer.write("/tf", transform(time), time)
    with open_bag(tmp_path / "made") as bag:
        for start in range(100, 160, 2):
            times = [m.log_time_ns for m in bag.messages(start_ns=start, end_ns=start + 10)]
            assert times == list(range(start, min(start + 11, 160), 2))
            between = [m.log_time_ns for m in bag.messages(start_ns=start + 1, end_ns=start + 9)]
            assert between == list(range(start + 2, min(start + 9, 160), 2))
            for window, count in (((start, start), 1), ((start + 1, start + 1), 0)):
                ends = {"start_ns": window[0], "end_ns": window[1]}
                assert len(list(bag.messages(**ends))) == count
                assert Buffer.from_bag(bag.path, **ends).bag_report.messages == count


def test_topic_names_are_whole_names(bag_path):
    # In the library `mcap` '/tf' also matched '/tf_static' when given as a text (mcap #1230).
    with open_bag(bag_path) as bag:
        assert {m.topic for m in bag.messages("/tf")} == {"/tf"}
        assert "/tf" in bag
        assert "/t" not in bag


def test_a_topic_that_is_not_there_is_named_with_the_nearest(bag_path):
    with open_bag(bag_path) as bag, pytest.raises(BagError, match="no topic '/chater'") as error:
        list(bag.messages("/chater"))
    assert error.value.hint == "Did you mean /chatter?"


def test_times_of_a_message(bag_path):
    with open_bag(bag_path) as bag:
        static = next(bag.messages("/tf_static"))
        assert static.log_time_ns == START
        assert static.publish_time_ns == START - SECOND
        assert next(bag.messages("/chatter")).publish_time_ns == START + 91_000_001


def test_a_single_file_is_a_bag(bag_path):
    with open_bag(bag_path) as bag, open_bag(bag_path / "made_0.mcap") as file:
        assert contents(file) == contents(bag)
        assert file.topics == bag.topics


def test_messages_are_in_order_of_time_across_overlapping_chunks_and_files(tmp_path):

    times = [(7 * i) % 101 for i in range(101)]
    with BagWriter(tmp_path / "mixed", chunk_bytes=200, max_file_bytes=2000) as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for number in times:
            writer.write("/a", number.to_bytes(4, "little"), 1000 + number)
    with open_bag(tmp_path / "mixed") as bag:
        assert len(bag.metadata.paths) > 2
        assert [m.log_time_ns for m in bag] == [1000 + i for i in range(101)]
        assert [m.log_time_ns for m in bag.messages(start_ns=1050, end_ns=1060)] == list(
            range(1050, 1061)
        )


def test_a_short_file_within_a_long_one_does_not_end_the_overlap(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for times in ((0, 55, 100), (10, 20), (50, 60), (100, 101)):
            for time in times:
                writer.write("/a", bytes(8), time)
            writer.split()
    with open_bag(tmp_path / "made") as bag:
        assert len([file for file in bag.metadata.files if file.message_count]) == 4
        assert [m.log_time_ns for m in bag] == [0, 10, 20, 50, 55, 60, 100, 100, 101]


def test_invalid_bags(tmp_path):
    with pytest.raises(FileNotFoundError, match="there is no bag at"):
        open_bag(tmp_path / "nothing")
    with pytest.raises(BagError, match=r"contains no \.mcap or \.db3 file"):
        open_bag(tmp_path)
    (tmp_path / "text.mcap").write_text("hello, world, I am no bag")
    with pytest.raises(BagError, match="neither an MCAP nor a sqlite3 file"):
        open_bag(tmp_path / "text.mcap")
    (tmp_path / "empty.db3").touch()
    with pytest.raises(BagError, match="neither an MCAP nor a sqlite3 file"):
        open_bag(tmp_path / "empty.db3")


def test_metadata_that_cannot_be_understood(tmp_path):
    folder = write_bag(tmp_path / "made")
    for text, complaint in [
        ("a: [1,", "not readable as YAML"),
        ("[" * 500, "^[^:]+: not readable as YAML: nested more than 50 deep"),
        # Since PyYAML 6.0.4 libyaml itself refuses more than 1,000 levels, before we count them.
        ("[" * 100_000, "^[^:]+: not readable as YAML: .*nest"),
        ("rosbag2_bagfile_information: 3", "is missing"),
        ("rosbag2_bagfile_information: {version: 9}", "'starting_time' is missing"),
    ]:
        (folder / "metadata.yaml").write_text(text)
        with pytest.raises(BagError, match=complaint):
            open_bag(folder)


def test_decompressed_copies_are_deleted(tmp_path, monkeypatch):
    import tempfile

    scratch = tmp_path / "scratch"
    scratch.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(scratch))
    folder = write_bag(tmp_path / "made", compression_mode="FILE")
    with open_bag(folder) as bag:
        assert len(list(bag)) == 111
        assert os.name != "posix" or list(scratch.iterdir()) == []  # also while they are read
    assert list(scratch.iterdir()) == []


def test_types_that_only_the_bag_defines(tmp_path):
    from turtlewire import msg

    text = (
        "uint8 A=1\nThing[] things\nother_only/Inner inner\n"
        + "=" * 80
        + "\nMSG: bag_only/Thing\nstring name\n"
        + "=" * 80
        + "\nMSG: other_only/Inner\nfloat64 x\nbuiltin_interfaces/Time stamp\n"
    )
    cdr = bytes.fromhex(
        "00010000 01000000 03000000 6869 00 00 00000000 000000000000f83f 0200000003000000"
    )
    with BagWriter(tmp_path / "own") as writer:
        writer.add_topic("/own", "bag_only/msg/Own", definition=("ros2msg", text))
        writer.write("/own", cdr, 1)
    with open_bag(tmp_path / "own") as bag:
        (message,) = bag
        own = message.decode()
    assert own.things[0].name == "hi"
    assert (own.inner.x, own.inner.stamp.sec, own.inner.stamp.nanosec) == (1.5, 2, 3)
    assert msg.serialize(own) == cdr


@pytest.mark.parametrize("topics", [["/a"], ["/b"], ["/a", "/b"], ["/b", "/a", "/empty"]])
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_small_and_large_messages_come_in_order(tmp_path, storage, topics):
    """A sqlite3 file is read in blocks, which are shorter after a message of 64 KiB."""
    written = []
    with BagWriter(tmp_path / "made", storage=storage) as writer:
        for name in ("/a", "/b", "/empty"):
            writer.add_topic(name, "std_msgs/msg/String")
        for number in range(400):
            topic = "/b" if number % 3 else "/a"
            size = (1 << 16) + number % 2 if 128 <= number % 150 < 140 else 8
            data = bytes([number % 256]) * size
            writer.write(topic, data, 1000 - number // 2)
            written.append((topic, "std_msgs/msg/String", 1000 - number // 2, data))
    written.sort(key=lambda each: each[2])
    with open_bag(tmp_path / "made") as bag:
        assert contents(bag.messages(topics)) == [each for each in written if each[0] in topics]


def parsed(bag):
    return ET.fromstring(f"<div>{bag._repr_html_()}</div>")


def rows(bag):
    return [[cell.text for cell in row] for row in parsed(bag).iterfind(".//tbody/tr")]


def paragraphs(bag):
    return [each.text for each in parsed(bag).iter("p")]


def caption(bag):
    return "".join(parsed(bag).find(".//caption").itertext())


@pytest.fixture
def described(tmp_path):
    """Return a bag with the given metadata."""
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
    with open_bag(tmp_path / "made") as bag:

        def describe(topics):
            bag.metadata = BagMetadata("mcap", topics=topics, message_count=7)
            return bag

        yield describe


def test_a_bag_shows_topics_types_counts_and_times(tmp_path, monkeypatch):
    monkeypatch.setattr("turtlewire.bag.notebook.date_text", lambda time: f"@{time - START}")
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        assert caption(bag) == "my_bag: 111 messages of 3 topics"
        assert rows(bag) == [
            ["/chatter", "std_msgs/msg/String", "10"],
            ["/tf", "tf2_msgs/msg/TFMessage", "100"],
            ["/tf_static", "tf2_msgs/msg/TFMessage", "1"],
        ]
        assert paragraphs(bag) == ["0.991 s, from @0 to @991000001; mcap, 1 file"]


def test_the_dates_are_those_of_bag_commands(tmp_path):
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        date = r"20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{9}[+-]\d\d:\d\d"
        assert re.search(f"from {date} to {date};", paragraphs(bag)[0])


def test_the_files_of_a_bag_are_not_read(tmp_path):
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        shutil.rmtree(tmp_path / "my_bag")
        assert len(rows(bag)) == 3
        assert bag._files == {}


def test_an_empty_bag_has_no_times(tmp_path):
    with BagWriter(tmp_path / "empty") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
    with open_bag(tmp_path / "empty") as bag:
        assert caption(bag) == "empty: 0 messages of 1 topic"
        assert paragraphs(bag) == ["mcap, 1 file"]


def test_names_cannot_contain_html_or_direction_marks(described):
    bag = described([TopicInfo("/<script>alert(1)</script>&\u202e", '"><img src=x onerror=f()>')])
    html = bag._repr_html_()
    assert "<script" not in html
    assert "<img" not in html
    assert rows(bag) == [["/<script>alert(1)</script>&\\u202e", '"><img src=x onerror=f()>', "0"]]


def test_the_name_and_the_problems_of_a_bag_are_escaped(tmp_path):
    path = write_bag(tmp_path / "<i>bag")
    with open_bag(path) as bag:
        bag.complain("<b>damaged")
        assert caption(bag).startswith("<i>bag: ")
        assert paragraphs(bag)[1:] == ["Problem: <b>damaged"]


def test_ten_problems_are_listed_and_more_are_counted(tmp_path):
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        bag.problems += [f"problem {number}" for number in range(10)]
        assert len(paragraphs(bag)) == 11
        bag.complain("another one")
        assert paragraphs(bag)[-1] == "bag.problems lists all 11 problems"
        assert len(paragraphs(bag)) == 12


@pytest.mark.parametrize("count", [500, 501, 10_000])
def test_the_first_500_topics_are_shown(described, count):
    bag = described(
        [TopicInfo(f"/topic{i:05}{'x' * 1000}", "std_msgs/msg/Empty") for i in range(count)]
    )
    assert len(rows(bag)) == 500
    cut = ", the first 500 of them shown" if count > 500 else ""
    assert caption(bag) == f"made: 7 messages of {count:,} topics{cut}"
    assert rows(bag)[499][0] == f"/topic00499{'x' * 108}…"
    assert len(bag._repr_html_()) < 300_000


def test_damage_is_shown(tmp_path):
    path = write_bag(tmp_path / "my_bag")
    (file,) = path.glob("*.mcap")
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    with open_bag(file) as bag:
        assert bag.problems
        assert paragraphs(bag)[1].startswith("Problem: ")


def test_a_bag_of_a_damaged_clock_is_shown(tmp_path):
    with BagWriter(tmp_path / "clock") as writer:
        text = msg.get_message("std_msgs/msg/String")(data="late")
        writer.write("/chatter", text, 2**63 - 1)
        writer.write("/chatter", text, SECOND)
    with open_bag(tmp_path / "clock") as bag:
        assert paragraphs(bag)[0].endswith("; mcap, 1 file")
