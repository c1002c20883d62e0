"""The transforms of a bag in a buffer: windows, names, reports and faults."""

import re
import sys
from pathlib import Path

import pytest
from tests.bags import SECOND, START, transform, write_bag

from turtlewire import Buffer, msg
from turtlewire.bag import Bag, BagWriter, mcap_storage, open_bag
from turtlewire.bag.files import open_storage
from turtlewire.bag.mcap_reader import McapFile
from turtlewire.cli.bag_tf import show_transforms
from turtlewire.errors import BagError, ExtrapolationException, LookupException
from turtlewire.trajectory import Trajectory


@pytest.mark.parametrize(
    "options", [{}, {"compression": "zstd", "chunk_bytes": 500}, {"storage": "sqlite3"}]
)
def test_one_call_fills_a_buffer(tmp_path, options):
    buffer = Buffer.from_bag(write_bag(tmp_path / "made", **options))
    report = buffer.bag_report
    middle = buffer.lookup_transform("odom", "camera", START + 505_000_000)
    assert middle.translation == pytest.approx((0.505, 0, 0))
    assert report.messages == 101
    assert {(link.child_frame, link.static) for link in report.links} == {
        ("camera", True),
        ("base_link", False),
    }
    assert (report.gaps, report.jumps, report.conflicts, report.problems) == ({}, [], [], [])


def test_an_open_bag_fills_a_buffer_and_stays_open(tmp_path):
    path = write_bag(tmp_path / "made")
    with open_bag(path) as bag:
        buffer = Buffer.from_bag(bag, end_ns=START + 500_000_000)
        assert sum(1 for _ in bag.messages("/chatter")) == 10
    assert str(buffer.bag_report) == str(
        Buffer.from_bag(path, end_ns=START + 500_000_000).bag_report
    )
    assert buffer.time_range("odom", "camera") == (START, START + 490_000_000)
    empty = tmp_path / "refused"
    with BagWriter(empty) as writer:
        writer.write("/tf", transform(0, "a", "a"), START)
    with open_bag(empty) as bag, pytest.warns(UserWarning, match=r"refused: .*"):
        Buffer.from_bag(bag)


def test_a_storage_file_walks_its_transforms_in_its_own_way(tmp_path, monkeypatch):
    """The reader asks the file, whatever class it is; only a file that refuses is read by rows."""
    path = write_bag(tmp_path / "made")
    asked = []

    class Wrapped:
        def __init__(self, file):
            self._file = file

        def __getattr__(self, name):
            return getattr(self._file, name)

        def walk_transforms(self, names, start_ns, end_ns, target):
            asked.append(sorted(names))
            return self._file.walk_transforms(names, start_ns, end_ns, target)

        def messages(self, *_):
            raise AssertionError("an MCAP file has chunks")

    monkeypatch.setattr("turtlewire.bag.reader.open_storage", lambda *a: Wrapped(open_storage(*a)))
    report = Buffer.from_bag(path).bag_report
    assert (report.messages, report.problems) == (101, [])
    assert asked == [["/tf_static"], ["/tf"]]


def test_files_without_chunks_refuse_the_walk(tmp_path):
    path = write_bag(tmp_path / "made", storage="sqlite3")
    (file,) = (open_storage(str(each)) for each in path.glob("*.db3"))
    assert file.walk_transforms({"/tf"}, 0, 1, None) is False
    assert file.counted_messages() is None
    file.close()


def test_history_is_not_limited(tmp_path):
    buffer = Buffer.from_bag(write_bag(tmp_path / "made", count=3000))
    assert buffer.lookup_transform("odom", "base_link", START).stamp_ns == START
    assert buffer.cache_time_ns is None
    short = Buffer.from_bag(tmp_path / "made", cache_time_ns=SECOND)
    with pytest.raises(ExtrapolationException):
        short.lookup_transform("odom", "base_link", START)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows which pages are resident")
def test_the_pages_of_chunks_that_were_read_are_given_back(tmp_path, monkeypatch):
    path = tmp_path / "made"
    with BagWriter(path, chunk_bytes=1_000_000) as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for count in range(60_000):
            writer.write("/tf", transform(count), count)
    resident = []

    class Watched(McapFile):
        def close(self):
            resident.append(resident_bytes(path / "made_0.mcap"))
            super().close()

    monkeypatch.setattr(mcap_storage, "McapFile", Watched)
    size = (path / "made_0.mcap").stat().st_size
    report = Buffer.from_bag(path).bag_report
    assert report.messages == 60_000
    assert max(resident) < size / 3


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows which pages are resident")
def test_reading_messages_leaves_no_pages_behind(tmp_path):
    """Neither those of the chunks, nor those that Linux maps around each page that is read."""
    path = tmp_path / "made"
    with BagWriter(path, chunk_bytes=100_000) as writer:
        writer.add_topic("/blob", "std_msgs/msg/String")
        for count in range(1000):
            writer.write("/blob", bytes(10_000), count)
    resident = {
        count: resident_bytes(path / "made_0.mcap")
        for count, _ in enumerate(Bag(path))
        if count in (100, 900)
    }
    assert resident[900] < resident[100] + 200_000


def resident_bytes(file):
    """Return the resident size of a mapped file in this process."""
    total, ours = 0, False
    for line in Path("/proc/self/smaps").read_text(encoding="utf-8").splitlines():
        if re.match(r"[0-9a-f]+-[0-9a-f]+ ", line):
            ours = line.endswith(str(file))
        elif ours and line.startswith("Rss:"):
            total += int(line.split()[1]) * 1024
    return total


def test_a_window_has_the_static_transforms_from_before_it(tmp_path):
    path = write_bag(tmp_path / "made", max_file_bytes=4000, chunk_bytes=500)
    start = START + SECOND // 2
    buffer = Buffer.from_bag(path, start_ns=start, end_ns=start + SECOND // 4)
    report = buffer.bag_report
    assert report.messages == 1 + 25
    buffer.lookup_transform("odom", "camera", start + 100_000_000)


def test_one_file_of_a_split_bag_says_where_the_rest_is(tmp_path):
    path = write_bag(tmp_path / "made", max_file_bytes=4000, chunk_bytes=500)
    first, *_, last = sorted(path.glob("*.mcap"), key=lambda file: int(file.stem.split("_")[1]))
    buffer = Buffer.from_bag(last)
    report = buffer.bag_report
    assert "camera" not in buffer
    assert (report.part_of, report.problems) == (str(path), [])
    assert f"open {path} for all of it, static transforms too" in report.complaints()[0]
    assert Buffer.from_bag(first).bag_report.part_of == str(path)
    assert Buffer.from_bag(path).bag_report.part_of == ""
    assert Buffer.from_bag(write_bag(tmp_path / "one") / "one_0.mcap").bag_report.part_of == ""
    (path / "metadata.yaml").write_text("[")
    assert Buffer.from_bag(last).bag_report.part_of == ""


def test_other_topic_names(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/robot1/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/robot1/tf", transform(1), 1)
    with pytest.raises(BagError, match="none of the topics /tf, /tf_static") as error:
        Buffer.from_bag(tmp_path / "made")
    assert "in it: /robot1/tf." in error.value.hint
    buffer = Buffer.from_bag(tmp_path / "made", topics="/robot1/tf")
    assert buffer.frames() == ["base_link", "odom"]


def test_gaps_jumps_two_parents_and_nonsense_are_reported(tmp_path):
    with BagWriter(tmp_path / "made", chunk_bytes=300) as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        times = [*range(100), *range(400, 500), *range(50, 80)]
        for log_time, i in enumerate(times):
            writer.write("/tf", transform(i), log_time)
            if i % 2:
                writer.write("/tf", transform(i, "map", "two_parents"), log_time)
            else:
                writer.write("/tf", transform(i, "odom", "two_parents"), log_time)
        writer.write("/tf", b"nonsense", 10_000)
    report = Buffer.from_bag(tmp_path / "made").bag_report
    assert report.gaps["base_link"] == [(START + 990_000_000, START + 4 * SECOND)]
    assert report.jumps == [(200, 4_490_000_000, ("base_link", "two_parents"))]
    assert report.two_parents == ["two_parents"]
    assert [conflict.kind for conflict in report.conflicts] == ["two parents"]
    assert report.malformed is not None
    assert report.malformed.messages == 1


def test_a_frame_that_changes_its_parent_once_is_reported(tmp_path):
    """This is not a conflict, as when a gripper picks up a part, but it affects lookups."""
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for i in range(20):
            parent = "table" if i < 10 else "gripper"
            writer.write("/tf", transform(i, parent, "part"), i)
            writer.write("/tf", transform(i, "map", "gripper"), i)
    report = Buffer.from_bag(tmp_path / "made").bag_report
    assert report.conflicts == []
    assert report.new_parents == [("part", "table", "gripper", START + 100_000_000)]
    assert report.two_parents == ["part"]
    assert (
        "new parent: 'part' leaves 'table' for 'gripper' at 1700000000.100000000"
        in report.complaints()
    )


def test_a_frame_that_is_handed_on_and_on(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for i in range(12):
            writer.write("/tf", transform(i, "abc"[i // 4], "part"), i)
    report = Buffer.from_bag(tmp_path / "made").bag_report
    assert (report.conflicts, report.two_parents) == ([], ["part"])
    assert [change[1:3] for change in report.new_parents] == [("a", "b"), ("b", "c")]


@pytest.mark.parametrize("first", ["/tf", "/tf_static"])
def test_a_frame_that_is_static_in_one_parent_and_moves_in_another(tmp_path, first):
    second = "/tf" if first == "/tf_static" else "/tf_static"
    with BagWriter(tmp_path / "made") as writer:
        for topic in (first, second):
            writer.add_topic(topic, "tf2_msgs/msg/TFMessage")
        for i in range(4):
            writer.write(first, transform(i, "a", "x"), i)
        for i in range(4):
            writer.write(second, transform(i, "b", "x"), 10 + i)
    report = Buffer.from_bag(tmp_path / "made").bag_report
    assert report.two_parents == ["x"]
    assert {each.kind for each in report.conflicts} == {"two publishers", "two parents"}


def test_small_steps_back_are_counted(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for log_time, i in enumerate([0, 1, 2, 1, 3, 4, 2, 5]):
            writer.write("/tf", transform(i), log_time)
    report = Buffer.from_bag(tmp_path / "made").bag_report
    assert report.steps_back == {"base_link": (2, 20_000_000)}
    assert report.complaints() == [
        "out of order: the stamps of 'base_link' step back 2 times, by up to 20 ms"
    ]


def test_jumps_are_not_told_twice(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for log_time, i in enumerate([*range(300), *range(300)]):
            writer.write("/tf", transform(i), log_time)
    (line,) = Buffer.from_bag(tmp_path / "made").bag_report.complaints()
    assert line.startswith("jump of time: ")


def test_many_jumps_are_summed_up(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for log_time in range(2000):
            i = log_time + (500 if log_time % 2 else 0)
            writer.write("/tf", transform(i), log_time)
    report = Buffer.from_bag(tmp_path / "made").bag_report
    lines = [line for line in report.complaints() if line.startswith("jump of time: ")]
    assert len(report.jumps) == 999
    assert lines[5:] == ["jump of time: and 994 more, by up to 4.990 s"]


@pytest.mark.parametrize("names", [{"topics": ["/tf", "/robto/tf"]}, {"static_topics": "/nothing"}])
def test_an_unknown_topic_beside_known_ones(tmp_path, names):
    path = write_bag(tmp_path / "made")
    with BagWriter(tmp_path / "moving") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/tf", transform(0), 1)
    wrong = "/nothing" if "static_topics" in names else "/robto/tf"
    with pytest.raises(BagError, match=f"made has no topic {wrong}") as error:
        Buffer.from_bag(path, **names)
    assert error.value.hint == "Topics of type tf2_msgs/msg/TFMessage in it: /tf_static, /tf."
    # The names that stand there by default need not be in the bag.
    assert Buffer.from_bag(tmp_path / "moving").bag_report.messages == 1
    assert Buffer.from_bag(tmp_path / "moving", topics=["/tf"]).bag_report.messages == 1


def test_a_topic_of_another_type(tmp_path):
    path = write_bag(tmp_path / "made")
    reason = "/chatter is of type std_msgs/msg/String, not tf2_msgs/msg/TFMessage"
    with pytest.raises(BagError, match=reason):
        Buffer.from_bag(path, topics=["/tf", "/chatter"])


def test_a_bag_without_transforms(tmp_path):
    """What it has instead, and who reads that."""
    pose = msg.get_message("geometry_msgs/msg/PoseStamped")()
    with BagWriter(tmp_path / "poses") as writer:
        writer.write("/pose", pose, log_time_ns=1)
    has = (
        "It has no TF (messages of type tf2_msgs/msg/TFMessage), only /pose "
        "(geometry_msgs/msg/PoseStamped). Trajectory.from_bag reads the poses of /pose."
    )
    for topics in ("/tf", "/pose"):
        with pytest.raises(BagError) as caught:
            Buffer.from_bag(tmp_path / "poses", topics=topics)
        assert caught.value.hint == has
    with BagWriter(tmp_path / "many") as writer:
        for number in range(10):
            writer.add_topic(f"/chatter{number}", "std_msgs/msg/String")
    with pytest.raises(BagError) as caught:
        Buffer.from_bag(tmp_path / "many")
    assert caught.value.hint.endswith("/chatter7 (std_msgs/msg/String) and 2 more.")


def test_a_saved_buffer_is_no_bag_and_a_bag_no_saved_buffer(tmp_path):
    bag = write_bag(tmp_path / "made")
    Buffer().save(tmp_path / "saved.npz")
    with pytest.raises(BagError, match="neither an MCAP nor a sqlite3 file") as caught:
        Buffer.from_bag(tmp_path / "saved.npz")
    assert caught.value.hint == "If Buffer.save wrote it, read it with Buffer.load."
    with pytest.raises(IsADirectoryError, match=r"to read a bag, call Buffer\.from_bag: '.*made'"):
        Buffer.load(bag)
    (file,) = Path(bag).glob("*.mcap")
    with pytest.raises(ValueError, match=r"not a saved buffer: .*; to read a bag, call Buffer\.fr"):
        Buffer.load(file)


def test_a_bag_is_no_file_of_a_trajectory(tmp_path):
    bag = write_bag(tmp_path / "made")
    with pytest.raises(IsADirectoryError, match=r"read a bag, call Trajectory\.from_bag: '.*made'"):
        Trajectory.load(bag)
    (file,) = Path(bag).glob("*.mcap")
    for kind in (None, "tum"):
        with pytest.raises(ValueError, match=r"it is not text; to read a bag, call Trajectory\.fr"):
            Trajectory.load(file, format=kind)


def test_a_window_that_ends_before_it_begins(tmp_path):
    import turtlewire
    from turtlewire.bag import open_bag

    path = write_bag(tmp_path / "made")
    reason = "ends before it begins: start_ns=5, end_ns=4"
    with pytest.raises(ValueError, match=reason):
        turtlewire.Buffer.from_bag(path, start_ns=5, end_ns=4)
    with open_bag(path) as bag, pytest.raises(ValueError, match=reason):
        next(bag.messages(start_ns=5, end_ns=4))
    with pytest.raises(ValueError, match=reason):
        turtlewire.trajectory.Trajectory.from_bag(path, "/tf", start_ns=5, end_ns=4)


def test_window_outside_the_bag_is_reported(tmp_path):
    path = write_bag(tmp_path / "made")
    report = Buffer.from_bag(path, start_ns=START + 100 * SECOND).bag_report
    (problem,) = report.problems
    assert f"window, from {START + 100 * SECOND} on: the bag covers {START} to " in problem
    assert Buffer.from_bag(path, end_ns=START - SECOND).bag_report.problems
    assert Buffer.from_bag(path, start_ns=START + SECOND // 2).bag_report.problems == []


def test_a_pickled_buffer_keeps_its_report(tmp_path):
    import copy
    import pickle

    import turtlewire

    buffer = turtlewire.Buffer.from_bag(write_bag(tmp_path / "made"))
    for again in (pickle.loads(pickle.dumps(buffer)), copy.copy(buffer), copy.deepcopy(buffer)):
        assert repr(again.bag_report) == repr(buffer.bag_report)
        assert again.bag_report.links == buffer.bag_report.links
    assert pickle.loads(pickle.dumps(turtlewire.Buffer())).bag_report is None


def test_progress_is_printed(tmp_path):
    shares = []
    Buffer.from_bag(write_bag(tmp_path / "made", chunk_bytes=500), progress=shares.append)
    assert shares == sorted(shares)
    assert len(shares) > 10
    assert shares[-1] == 1.0


def test_chunks_without_transforms_are_not_decompressed(tmp_path, monkeypatch):
    from turtlewire.bag import mcap_reader

    with BagWriter(tmp_path / "made", chunk_bytes=10_000) as writer:
        writer.add_topic("/image", "std_msgs/msg/String")
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for i in range(100):
            writer.write("/image", bytes(20_000), i)
        writer.write("/tf", transform(0), 100)
    read = []
    records = mcap_reader.McapFile.records
    monkeypatch.setattr(
        mcap_reader.McapFile,
        "records",
        lambda self, chunk: read.append(chunk) or records(self, chunk),
    )
    Buffer.from_bag(tmp_path / "made")
    assert len(read) == 1


def test_a_window_of_datetimes(tmp_path):
    import numpy as np

    from turtlewire.bag import open_bag

    path = write_bag(tmp_path / "made")
    start = np.datetime64(START + SECOND // 2, "ns")
    report = Buffer.from_bag(
        path, start_ns=start, end_ns=start + np.timedelta64(250, "ms")
    ).bag_report
    assert report.messages == 1 + 25
    with open_bag(path) as bag:
        assert len(list(bag.messages("/tf", start_ns=start))) == 50


def test_images_in_a_bag_take_no_memory(tmp_path):
    """No more than two chunks are held at a time."""
    import tracemalloc

    for compression in ("", "zstd"):
        path = tmp_path / f"made {compression}"
        with BagWriter(path, compression=compression) as writer:
            writer.add_topic("/image", "std_msgs/msg/String")
            writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
            for i in range(60):
                writer.write("/image", bytes(1_000_000), i)
                writer.write("/tf", transform(i), i)
        tracemalloc.start()
        report = Buffer.from_bag(path).bag_report
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert report.messages == 60
        assert peak < 10_000_000


def test_progress_is_drawn_on_a_terminal_after_a_second(monkeypatch):
    import io
    import sys
    import time

    from turtlewire.bag.progress import progress_line

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    now = 100.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    monkeypatch.setattr(sys, "stderr", Terminal())
    tell = progress_line("reading my_bag")
    tell(0.3)
    assert sys.stderr.getvalue() == ""
    now = 102.0
    tell(0.5)
    assert sys.stderr.getvalue() == (
        "\rreading my_bag [###############---------------]  50%, 2 s left\033[K"
    )
    tell(1.0)
    assert sys.stderr.getvalue().endswith("\r\033[K")
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    quiet = progress_line("reading my_bag")
    now = 104.0
    quiet(0.5)
    assert sys.stderr.getvalue() == ""


def test_a_bag_whose_transforms_are_all_refused(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.write("/tf", transform(0, "odom", "odom"), START)
    with pytest.warns(UserWarning, match="made: Refused .*: 1; for example, TF_SELF_TRANSFORM"):
        buffer = Buffer.from_bag(tmp_path / "made")
    with pytest.raises(LookupException) as caught:
        buffer.lookup_transform("odom", "base_link")
    assert "TF_SELF_TRANSFORM" in caught.value.hint
    assert "1 self_transform" in show_transforms(
        str(tmp_path / "made"), "/tf", "/tf_static", as_json=False
    )
