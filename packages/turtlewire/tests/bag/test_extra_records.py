"""Attachments and metadata records in parts of bags, read and written by the library of MCAP."""

import pytest
from mcap.reader import make_reader
from mcap.writer import IndexType, Writer

from ros2cli.main import main as ros2
from turtlewire.bag import copy_bag, merge_bags, open_bag, split_bag
from turtlewire.bag.mcap_records import Op
from turtlewire.cli.main import main

TIMES = range(100, 200, 10)
ATTACHMENTS = [(0, "calibration"), (50, "early"), (119, "a"), (120, "b"), (155, "c"), (900, "late")]
METADATA = [("robot", {"name": "r2"}), ("robot", {"name": "d2"}), ("empty", {})]


def write(path, times=TIMES, attachments=ATTACHMENTS, metadata=METADATA, last=None, **options):
    """Write an MCAP file with extra records before, between and behind its chunks."""
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=100, **options)
        writer.start("ros2")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        channel = writer.register_channel("/a", "cdr", schema)
        for number, time in enumerate(times):
            if number == len(times) // 2:
                for log_time, name in attachments:
                    data = name.encode() * 9
                    writer.add_attachment(7, log_time, name, "text/plain", data)
                for name, entries in metadata:
                    writer.add_metadata(name, entries)
            data = b"\0\1\0\0\2\0\0\0x\0"
            writer.add_message(channel, time, data, time, number)
        if last is not None:
            channel = writer.register_channel("/z", "cdr", schema)
            writer.add_message(channel, last, data, last)
        writer.finish()
    return path


def extras(folder):
    """Attachments, and metadata without rosbag2's own, as the library of MCAP reads them."""
    attachments, metadata = [], []
    for file in sorted(folder.glob("*.mcap")):
        with file.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True)
            found = list(reader.iter_attachments())
            attachments += [(each.log_time, each.name) for each in found]
            for each in found:
                assert (each.create_time, each.media_type) == (7, "text/plain")
                assert each.data == each.name.encode() * 9
            records = list(reader.iter_metadata())
            metadata += [(e.name, e.metadata) for e in records if e.name != "rosbag2"]
            statistics = reader.get_summary().statistics
            assert statistics.attachment_count == len(found)
            assert statistics.metadata_count == len(records)
    return attachments, metadata


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"index_types": IndexType.CHUNK | IndexType.MESSAGE},
        {"index_types": IndexType.NONE},
        {"use_statistics": False},
        {"use_chunking": False},
    ],
)
def test_all_are_kept_however_the_file_lists_them(tmp_path, options):
    source = write(tmp_path / "in.mcap", **options)
    copy_bag(source, tmp_path / "whole")
    assert extras(tmp_path / "whole") == (ATTACHMENTS, METADATA)
    with open_bag(tmp_path / "whole") as bag:
        assert len(list(bag)) == len(TIMES)


def test_a_cut_keeps_the_attachments_of_its_time(tmp_path, capsys):
    source = write(tmp_path / "in.mcap")
    assert main(["bag", "cut", str(source), "-o", str(tmp_path / "cut"), "--from", "20ns"]) == 0
    assert extras(tmp_path / "cut") == ([(120, "b"), (155, "c"), (900, "late")], METADATA)
    copy_bag(source, tmp_path / "middle", start="19ns", end="55ns", rename_topics={"/a": "/b"})
    assert extras(tmp_path / "middle") == ([(119, "a"), (120, "b")], METADATA)
    words = ["bag", "filter", str(source), "-o", str(tmp_path / "f"), "--type", "std_msgs/*"]
    assert main([*words, "--compression", "file"]) == 0
    copy_bag(tmp_path / "f", tmp_path / "plain", compression="none")
    assert extras(tmp_path / "plain") == (ATTACHMENTS, METADATA)
    assert capsys.readouterr().err == ""


def test_pieces_have_the_metadata_and_their_own_attachments(tmp_path):
    source = write(tmp_path / "in.mcap")
    done = split_bag(source, tmp_path / "parts", at=["20ns", "55ns"])
    expected = [ATTACHMENTS[:3], ATTACHMENTS[3:4], ATTACHMENTS[4:]]
    for number, attachments in enumerate(expected):
        assert extras(tmp_path / "parts" / f"parts_{number}") == (attachments, METADATA)
    merge_bags(done.paths, tmp_path / "again")
    assert extras(tmp_path / "again") == (ATTACHMENTS, METADATA)
    split_bag(source, tmp_path / "small", size=1)
    assert extras(tmp_path / "small" / "small_0") == (ATTACHMENTS, METADATA)
    assert extras(tmp_path / "small" / "small_1") == ([], METADATA)


def test_an_attachment_without_a_bag_goes_into_the_next_or_is_named(tmp_path):
    attachments = [(120, "b"), (170, "late")]
    source = write(tmp_path / "in.mcap", times=[100, 140], attachments=attachments, last=190)
    done = split_bag(source, tmp_path / "parts", at=["10ns", "30ns", "60ns"], topics="/a")
    assert len(done.paths) == 2
    assert extras(tmp_path / "parts" / "parts_0") == ([], METADATA)
    assert extras(tmp_path / "parts" / "parts_1") == ([(120, "b")], METADATA)
    (problem,) = done.problems
    assert problem.startswith("the attachment 'late' of 170 ns is left out")


def test_records_that_sqlite_cannot_hold_are_named(tmp_path, capsys):
    source = write(tmp_path / "in.mcap", attachments=[(0, "map")], metadata=[("robot", {})])
    words = ["bag", "cut", str(source), "-o", str(tmp_path / "out"), "--storage", "sqlite3"]
    assert main([*words, "--from", "0s"]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert [line.partition(": ")[2] for line in lines] == [
        "the attachment 'map' of 0 ns is left out: only MCAP files have such records",
        "the metadata record 'robot' is left out: only MCAP files have such records",
    ]


def test_merged_bags_have_each_record_once(tmp_path):
    one = write(tmp_path / "one.mcap", attachments=[(3, "x"), (4, "y")])
    two = write(tmp_path / "two.mcap", attachments=[(4, "y"), (5, "z")], metadata=[("new", {})])
    merge_bags([one, two], tmp_path / "both")
    found = extras(tmp_path / "both")
    assert found == ([(3, "x"), (4, "y"), (5, "z")], [*METADATA, ("new", {})])


def test_a_damaged_attachment_costs_no_message(tmp_path):
    source = write(tmp_path / "in.mcap", attachments=[(0, "map"), (1, "mop")])
    data = bytearray(source.read_bytes())
    at = data.index(b"\3\0\0\0map") - 16 - 9
    assert data[at] == Op.ATTACHMENT
    data[at + 9 + 16 : at + 9 + 20] = b"\xff" * 4  # the length of the name
    source.write_bytes(data)
    done = copy_bag(source, tmp_path / "out")
    (problem,) = done.problems
    assert f"record at byte {at} is left out: a field is longer than its record" in problem
    assert extras(tmp_path / "out") == ([(1, "mop")], METADATA)
    assert done.messages == len(TIMES)


def test_a_repaired_bag_keeps_them(tmp_path):
    folder = tmp_path / "bag"
    folder.mkdir()
    source = write(folder / "bag_0.mcap")
    source.write_bytes(source.read_bytes()[:-200])
    assert ros2(["bag", "reindex", str(folder)]) in (0, None)
    assert (folder / "bag_0.mcap.damaged").exists()
    assert extras(folder) == (ATTACHMENTS, METADATA)
