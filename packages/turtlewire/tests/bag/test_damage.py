"""Cut, damaged and hostile files: what is whole is read, the rest is named, nothing crashes."""

import contextlib
import os
import random
import re
import shutil
import signal
import sqlite3
import struct
import subprocess
import sys
import tracemalloc
import zlib
from itertools import pairwise
from types import SimpleNamespace

import pytest
from tests.bags import START, contents, write_bag

from turtlewire import Buffer
from turtlewire.bag import BagWriter, describe_bag, open_bag, reindex
from turtlewire.bag.compression import compress, decompress, most_bytes, unpack_file
from turtlewire.bag.mcap_records import Op
from turtlewire.bag.qos_yaml import profiles_from_yaml, profiles_to_text
from turtlewire.errors import BagError
from turtlewire.wire.qos import QoS

from .conftest import GOLDEN


def read_what_there_is(path):
    """All messages that can be read, and the complaint."""
    messages = []
    try:
        with open_bag(path) as bag:
            messages.extend(bag)
            return messages, " ".join(bag.problems)
    except BagError as error:
        return messages, str(error)


@pytest.mark.parametrize("compression", ["", "zstd", "lz4"])
def test_a_file_cut_anywhere(tmp_path, compression):
    folder = write_bag(tmp_path / "made", compression=compression, chunk_bytes=1000)
    (path,) = folder.glob("*.mcap")
    whole = path.read_bytes()
    with open_bag(path) as bag:
        expected = contents(bag)
    for length in range(0, len(whole), max(1, len(whole) // 200)):
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(whole[:length])
        messages, complaint = read_what_there_is(cut)
        assert contents(messages) == expected[: len(messages)]
        # A cut between two records in front of the summary cannot be seen.
        assert complaint or len(messages) == len(expected) or whole[length:].startswith(b"\x06")
    assert len(messages) == len(expected)


@pytest.mark.parametrize("compression", ["", "zstd", "lz4"])
def test_whole_messages_of_a_cut_chunk_are_read(tmp_path, compression):
    """A recorder that was killed leaves such a file: reading it ends like that of any other."""
    folder = write_bag(tmp_path / "made", 20_000, compression=compression, chunk_bytes=1 << 24)
    (path,) = folder.glob("*.mcap")
    with open_bag(path) as bag:
        expected = contents(bag)
    whole = path.read_bytes()
    for length in (len(whole) // 4, len(whole) // 2):
        path.write_bytes(whole[:length])
        with open_bag(path) as bag:
            assert contents(bag) == expected[: len(bag)]
            assert len(bag) > 4000
            assert "is cut off or damaged" in bag.problems[0]
            assert len(bag.problems) == 1
        report = Buffer.from_bag(path).bag_report
        assert report.messages > 4000
        assert len(report.problems) == 1


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("compression_mode", ["", "FILE"])
def test_flipped_bytes_never_crash(tmp_path, storage, compression_mode):
    folder = write_bag(
        tmp_path / "made", storage=storage, compression_mode=compression_mode, chunk_bytes=1000
    )
    (path,) = (file for file in folder.iterdir() if file.suffix != ".yaml")
    whole = path.read_bytes()
    dice = random.Random(1)
    for _ in range(150):
        damaged = bytearray(whole)
        for _ in range(dice.randint(1, 4)):
            damaged[dice.randrange(len(damaged))] = dice.randrange(256)
        path.write_bytes(damaged)
        messages, _ = read_what_there_is(folder)
        assert len(messages) <= 111 + 10


def test_a_damaged_definition_is_named(tmp_path):
    data = bytearray((GOLDEN / "d_mcap" / "d_mcap_0.mcap").read_bytes())  # it has no checksums
    name = b"tf2_msgs/msg/TFMessage"
    data[data.index(len(name).to_bytes(4, "little") + name) + 4] = 0xFF
    path = tmp_path / "damaged.mcap"
    path.write_bytes(data)
    _, complaint = read_what_there_is(path)
    assert re.search(r"damaged\.mcap: chunk at byte \d+: .* a string is not UTF-8", complaint)


def test_a_damaged_chunk_is_named_and_the_others_are_read(tmp_path):
    folder = write_bag(tmp_path / "made", compression="zstd", chunk_bytes=1000)
    (path,) = folder.glob("*.mcap")
    data = bytearray(path.read_bytes())
    second = data.index(b"\x04\x00\x00\x00zstd", data.index(b"\x04\x00\x00\x00zstd") + 1)
    data[second + 30] ^= 0xFF
    path.write_bytes(data)
    read, complaint = read_what_there_is(folder)
    assert 80 < len(read) < 111
    assert re.search(r"made_0\.mcap: chunk at byte \d+", complaint)


def test_plain_chunks_are_checked_once_and_damaged_ones_always(tmp_path, monkeypatch):
    folder = write_bag(tmp_path / "made", chunk_bytes=1000)
    checked, crc32 = [], zlib.crc32
    monkeypatch.setattr(zlib, "crc32", lambda data: checked.append(1) or crc32(data))
    with open_bag(folder) as bag:
        assert len(list(bag.messages("/tf"))) == 100
        chunks = len(checked)
        assert chunks > 10
        assert len(list(bag.messages("/tf"))) == 100
        assert len(checked) == chunks
    (path,) = folder.glob("*.mcap")
    data = bytearray(path.read_bytes())
    data[data.index(b"number 9") + 7] = ord("8")
    path.write_bytes(data)
    with open_bag(folder) as bag:
        for _ in range(2):
            with pytest.raises(BagError, match="the checksum does not match"):
                list(bag.messages("/chatter"))


def chunk_of(size, compressed):
    """An MCAP file with one zstd chunk that says that it holds ``size`` bytes."""
    body = struct.pack("<QQQI", 0, 1, size, 0) + struct.pack("<I", 4) + b"zstd"
    body += struct.pack("<Q", len(compressed)) + compressed
    return b"\x89MCAP0\r\n" + struct.pack("<BQ", 6, len(body)) + body


@pytest.mark.parametrize("size", [1000, 1 << 63])
def test_a_bomb_needs_no_memory(tmp_path, size):
    path = tmp_path / "bomb.mcap"
    path.write_bytes(chunk_of(size, compress("zstd", bytes(1 << 28))))
    tracemalloc.start()
    messages, complaint = read_what_there_is(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert messages == []
    assert "decompresses to 1001 bytes" in complaint or f"holds {size} bytes" in complaint
    assert peak < 10_000_000


@pytest.fixture
def small_limits(monkeypatch):
    """Limits of 1 MiB and 4 MiB, so that tests of them need little memory."""
    from turtlewire.bag import compression

    monkeypatch.setattr(compression, "_ALWAYS_BYTES", 1 << 20)
    monkeypatch.setattr(compression, "_MAX_BYTES", 1 << 22)


@pytest.mark.parametrize("told", [True, False])
def test_excessive_growth_is_rejected(small_limits, told):
    """Zstandard shrinks zeros to a 20,000th; lz4 to a 250th only, which is always allowed."""
    largest = compress("zstd", bytes(1 << 20))
    assert decompress("zstd", largest, 1 << 20 if told else None) == bytes(1 << 20)
    size = (1 << 20) + 1
    with pytest.raises(BagError, match=r"more than 1048576|at most 1048576 are read"):
        decompress("zstd", compress("zstd", bytes(size)), size if told else None)
    assert decompress("lz4", compress("lz4", bytes(size)), size if told else None) == bytes(size)


def test_usual_growth_is_read_up_to_the_absolute_limit(small_limits):
    for size in (1 << 22, (1 << 22) + 1):
        packed = compress("zstd", random.Random(1).randbytes(5000) + bytes(size - 5000))
        assert most_bytes(len(packed)) == 1 << 22
        if size == 1 << 22:
            assert len(decompress("zstd", packed, size)) == size
        else:
            with pytest.raises(BagError, match="at most 4194304 are read"):
                decompress("zstd", packed, size)


@pytest.mark.parametrize("size", [1_000_000, 1 << 20, 1 << 22])
@pytest.mark.parametrize("compression", ["zstd", "lz4"])
def test_reader_reads_the_writer_output(tmp_path, small_limits, compression, size):
    """A map of one value grows as much as a bomb: beyond the limit its chunk is not compressed."""
    with BagWriter(tmp_path / "made", compression=compression) as writer:
        writer.add_topic("/map", "nav_msgs/msg/OccupancyGrid")
        writer.write("/map", bytes(size), 1)
    messages, complaint = read_what_there_is(tmp_path / "made")
    assert [(len(message.data), complaint) for message in messages] == [(size, "")]
    packed = (tmp_path / "made" / "made_0.mcap").stat().st_size
    most = {"zstd": 1 << 20, "lz4": 1 << 22}[compression]
    assert (packed < size) == (size < most)


def test_a_large_map_of_one_value_is_read(tmp_path):
    with BagWriter(tmp_path / "made", compression="zstd") as writer:
        writer.add_topic("/map", "nav_msgs/msg/OccupancyGrid")
        writer.write("/map", bytes(9000 * 9000), 1)
    assert (tmp_path / "made" / "made_0.mcap").stat().st_size < 20_000
    (message,) = open_bag(tmp_path / "made")
    assert len(message.data) == 9000 * 9000


@pytest.mark.parametrize("mode", ["MESSAGE", "FILE"])
def test_a_large_map_of_one_value_is_read_from_a_database(tmp_path, mode):
    with BagWriter(tmp_path / "made", storage="sqlite3", compression_mode=mode) as writer:
        writer.add_topic("/map", "nav_msgs/msg/OccupancyGrid")
        writer.write("/map", bytes(9000 * 9000), 1)
    with open_bag(tmp_path / "made") as bag:
        (message,) = bag
        assert (len(message.data), bag.problems) == (9000 * 9000, [])


def test_a_message_that_the_reader_would_refuse_is_not_written(tmp_path, small_limits):
    with BagWriter(tmp_path / "made", storage="sqlite3", compression_mode="MESSAGE") as writer:
        writer.add_topic("/map", "nav_msgs/msg/OccupancyGrid")
        writer.write("/map", bytes(1 << 20), 1)
        with pytest.raises(BagError, match="1048577 bytes, and readers accept at most 1048576"):
            writer.write("/map", bytes((1 << 20) + 1), 2)
    assert read_what_there_is(tmp_path / "made")[0][0].log_time_ns == 1


NO_MEMORY = """
import resource
from turtlewire.bag.compression import compress, decompress
from turtlewire.errors import BagError

packed = compress("zstd", bytes(1 << 28))
resource.setrlimit(resource.RLIMIT_AS, (1 << 28, 1 << 28))
try:
    decompress("zstd", packed, 1 << 28)
except BagError as error:
    print(error)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits the memory of a process")
def test_a_chunk_that_does_not_fit_into_the_memory_is_damage():
    command = [sys.executable, "-c", NO_MEMORY]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert re.fullmatch(r"\d+ bytes decompress to more than the memory .*\n", done.stdout)


@pytest.mark.parametrize("topics", [None, "/tf"])
def test_a_refused_chunk_of_a_file_without_summary_is_an_error(tmp_path, topics):
    """A reader of the messages alone would take the rest for all of them."""
    folder = write_bag(tmp_path / "made", compression="zstd", chunk_bytes=1000)
    (path,) = folder.glob("*.mcap")
    data = bytearray(path.read_bytes())
    second = data.index(b"\x04\x00\x00\x00zstd", data.index(b"\x04\x00\x00\x00zstd") + 1)
    data[second - 12 : second - 4] = struct.pack("<Q", 1 << 62)
    path.write_bytes(data[:-100])
    found = []
    with open_bag(path) as bag:
        with pytest.raises(BagError, match=rf"chunk at byte \d+: .* holds {1 << 62} bytes"):
            found.extend(bag.messages(topics))
        (problem,) = bag.problems
        assert str(1 << 62) in problem
    assert 50 < len(found) < 111


def test_a_file_with_a_refused_chunk_only_is_an_error(tmp_path):
    path = tmp_path / "refused.mcap"
    path.write_bytes(chunk_of(1 << 62, b"x"))
    with open_bag(path) as bag, pytest.raises(BagError, match=f"holds {1 << 62} bytes"):
        list(bag)


def test_a_copy_that_fills_the_disk(tmp_path, monkeypatch):
    folder = write_bag(tmp_path / "made", compression_mode="FILE")
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=1000))
    messages, complaint = read_what_there_is(folder)
    assert messages == []
    assert "of the disk free" in complaint or "is neither an MCAP nor" in complaint


@pytest.mark.parametrize("name", ["d_mcap", "real/g_mcap_zstd_fast", "real/g_sqlite3"])
def test_a_real_bag_cut_at_every_thousandth_byte(tmp_path, name):
    """What `Buffer.from_bag` takes are the messages before the cut, and it says where that is."""
    (path,) = (file for file in (GOLDEN / name).iterdir() if file.suffix in {".mcap", ".db3"})
    whole = path.read_bytes()
    cut = tmp_path / path.name
    last, complaints = 0, []
    for length in range(0, len(whole), 1000):
        cut.write_bytes(whole[:length])
        try:
            report = Buffer.from_bag(cut).bag_report
        except BagError as error:
            complaints.append(str(error))
            continue
        # Of a .db3 the messages of a page that is cut are given up.
        assert report.messages >= (0.7 * last if path.suffix == ".db3" else last)
        assert report.problems or report.messages == last
        last = report.messages
    report = Buffer.from_bag(path).bag_report
    assert 0 < last <= report.messages
    assert all(str(cut) in complaint for complaint in complaints)


@pytest.mark.parametrize("size", [100, 20_000])
def test_a_sqlite_file_cut_anywhere(tmp_path, size):
    """sqlite3 refuses to open it, and takes zeros for what is missing of a page."""
    with BagWriter(tmp_path / "made", storage="sqlite3") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for i in range(300 * 100 // size + 50):
            writer.write("/a", random.Random(i).randbytes(size), START + i)
    (path,) = (tmp_path / "made").glob("*.db3")
    whole = path.read_bytes()
    with open_bag(path) as bag:
        expected = contents(bag)
    cut, counts = tmp_path / "cut.db3", []
    for length in range(len(whole) - 1, 0, -len(whole) // 100):
        cut.write_bytes(whole[:length])
        messages, complaint = read_what_there_is(cut)
        assert contents(messages) == expected[: len(messages)]
        assert f"its last {len(whole) - length:,} bytes are missing" in complaint or length < 16
        counts.append(len(messages))
    # A cut between two pages loses nothing of what lies before it, one within a page that page.
    page = 4096 // size + 2
    assert all(longer >= shorter - page for longer, shorter in pairwise(counts))
    assert counts[len(counts) // 2] > len(expected) // 8
    assert counts[0] > len(expected) * 0.8


def test_flipped_bytes_in_the_native_walk(tmp_path):
    folder = write_bag(tmp_path / "made", compression="zstd", chunk_bytes=1000)
    (path,) = folder.glob("*.mcap")
    whole = path.read_bytes()
    dice = random.Random(2)
    for _ in range(150):
        damaged = bytearray(whole)
        for _ in range(dice.randint(1, 4)):
            damaged[dice.randrange(len(damaged))] = dice.randrange(256)
        path.write_bytes(damaged)
        try:
            buffer = Buffer.from_bag(folder)
            report = buffer.bag_report
        except BagError:
            continue
        assert report.messages <= 101 + 10
        assert len(buffer.frames()) < 10


def test_a_missing_file_is_named_and_the_others_are_read(tmp_path):
    folder = write_bag(tmp_path / "made", max_file_bytes=4000, chunk_bytes=500)
    first, second, *_ = sorted(folder.glob("*.mcap"))
    second.unlink()
    report = Buffer.from_bag(folder).bag_report
    assert 10 < report.messages < 101
    assert second.name in " ".join(report.problems)
    first.unlink()


def test_a_length_bomb_needs_no_memory(tmp_path):
    path = tmp_path / "bomb.mcap"
    path.write_bytes(b"\x89MCAP0\r\n" + struct.pack("<BQ", 3, 1 << 62) + bytes(100))
    assert read_what_there_is(path)[1].count("cut off or damaged") == 1


WRITER = """
import sys
from turtlewire.bag import BagWriter

writer = BagWriter(sys.argv[1], storage=sys.argv[2], compression=sys.argv[3])
writer.add_topic("/a", "std_msgs/msg/String")
for i in range(1000):
    writer.write("/a", b"x" * 100, 1000 + i)
writer.flush()
for i in range(10):
    writer.write("/a", b"y" * 100, 3000 + i)
print("flushed", flush=True)
sys.stdin.read()
"""


@pytest.mark.parametrize(
    ("storage", "compression"), [("mcap", ""), ("mcap", "zstd"), ("sqlite3", "")]
)
def test_flushed_messages_survive_kill_9(tmp_path, storage, compression):
    folder = tmp_path / "made"
    command = [sys.executable, "-c", WRITER, str(folder), storage, compression]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"flushed\n"
        process.send_signal(signal.SIGKILL)
    assert not (folder / "metadata.yaml").exists()
    with open_bag(folder) as bag:
        assert [m.log_time_ns for m in bag] == [1000 + i for i in range(1000)]
        assert bag.topics["/a"].type == "std_msgs/msg/String"
        assert bag.metadata.message_count == 1000
    reindex(folder)
    with open_bag(folder) as bag:
        assert bag.metadata.storage == storage
        assert len(list(bag)) == 1000


def test_nothing_is_lost_of_an_unfinished_file_with_bare_messages(tmp_path):
    # As the preset `fastwrite` writes: no chunks, no index; here the summary is missing, too.
    from .conftest import GOLDEN

    source = next((GOLDEN / "real" / "g_mcap_fastwrite").glob("*.mcap"))
    whole = source.read_bytes()
    path = tmp_path / "cut.mcap"
    path.write_bytes(whole[: len(whole) * 2 // 3])
    messages, complaint = read_what_there_is(path)
    assert 100 < len(messages) < 223
    assert "all data before it is read" in complaint
    assert all(m.log_time_ns > START for m in messages)


def test_a_missing_file_of_messages_is_named_and_the_others_are_read(tmp_path):
    folder = write_bag(tmp_path / "made", max_file_bytes=4000, chunk_bytes=500)
    (second,) = folder.glob("*_1.mcap")
    second.unlink()
    found = []
    with open_bag(folder) as bag:
        with pytest.raises(BagError, match=second.name) as error:
            found.extend(bag)
        assert found[-1].log_time_ns == START + 991_000_001
        assert 50 < len(found) < 111
        assert len(bag.problems) == 1
    assert "reindex" in error.value.hint
    assert sum(second.name in line for line in Buffer.from_bag(folder).bag_report.problems) == 1


@pytest.mark.parametrize("number", [0, 1])
def test_an_overview_names_a_missing_file_and_measures_the_others(tmp_path, number):
    folder = write_bag(tmp_path / "made", max_file_bytes=4000, chunk_bytes=500)
    (folder / f"made_{number}.mcap").unlink()
    found = describe_bag(folder)
    assert 50 < next(topic.count for topic in found.topics if topic.name == "/tf") < 100
    assert sum(f"made_{number}.mcap" in problem for problem in found.problems) == 1


def test_a_summary_that_lists_a_chunk_without_bytes_is_not_used(tmp_path):
    (path,) = write_bag(tmp_path / "made").glob("*.mcap")
    data = bytearray(path.read_bytes())
    footer = len(data) - 8 - 29
    (at,) = struct.unpack_from("<Q", data, footer + 9)
    while data[at] != Op.CHUNK_INDEX:
        at += 9 + int.from_bytes(data[at + 1 : at + 9], "little")
    struct.pack_into("<QQ", data, at + 9 + 16, len(data), 0)
    struct.pack_into("<I", data, footer + 9 + 16, 0)  # the summary has no checksum
    path.write_bytes(data)
    messages, complaint = read_what_there_is(path)
    assert len(messages) == 111
    assert "lists a chunk that is empty" in complaint


def test_damaged_metadata_in_a_file_costs_no_message(tmp_path):
    (path,) = write_bag(tmp_path / "made").glob("*.mcap")
    whole = path.read_bytes()
    for damage in (b"[", b"\xff"):
        path.write_bytes(whole.replace(b"version: 9", b"version: " + damage))
        with open_bag(path) as bag:
            assert len(list(bag)) == 111
            assert "metadata" in " ".join(bag.problems)


@pytest.mark.parametrize("content", [b"", b"\xff", b"a: [", b"a: 2001-99-99", b"a: 1"])
def test_a_damaged_metadata_file_names_the_remedy(tmp_path, content):
    folder = write_bag(tmp_path / "made")
    (folder / "metadata.yaml").write_bytes(content)
    with pytest.raises(BagError) as error:
        open_bag(folder)
    assert "ros2 bag reindex" in error.value.hint
    assert reindex(folder).message_count == 111


@pytest.mark.parametrize("count", ["-1", ".inf", str(2**63)])
def test_an_impossible_number_of_messages_names_the_remedy(tmp_path, count):
    folder = write_bag(tmp_path / "made")
    text = (folder / "metadata.yaml").read_text()
    (folder / "metadata.yaml").write_text(
        text.replace("message_count: 111", f"message_count: {count}")
    )
    with pytest.raises(BagError) as error:
        open_bag(folder)
    assert "ros2 bag reindex" in error.value.hint


@pytest.mark.parametrize("depth", ["x", ".inf", ".nan", "[]"])
def test_an_impossible_depth_is_damage(depth):
    text = profiles_to_text([QoS(depth=3)], 9).replace("depth: 3", f"depth: {depth}")
    with pytest.raises(BagError, match=r"^here: not a list of QoS profiles: "):
        profiles_from_yaml(text, "here")


@pytest.mark.parametrize("room_mib", [490, 510])
def test_a_file_that_grows_too_much_takes_half_of_the_room(tmp_path, monkeypatch, room_mib):
    free = [1000 << 20]  # when it begins; then what is left of the room
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=free.pop(0)))
    path = tmp_path / "made.mcap.zstd"
    path.write_bytes(compress("zstd", bytes(3 << 20)))
    free += [room_mib << 20] * 3
    problems = []
    copy = unpack_file(str(path), str(tmp_path), problems.append)
    if room_mib == 510:
        assert problems == []
        assert os.path.getsize(copy) == 3 << 20
    else:
        assert "would leave less than" in problems[0]
        assert os.path.getsize(copy) < 3 << 20


def test_a_damaged_message_is_named_and_the_others_are_read(tmp_path):
    folder = write_bag(tmp_path / "made", storage="sqlite3", compression_mode="MESSAGE")
    (path,) = folder.glob("*.db3")
    with contextlib.closing(sqlite3.connect(path)) as database, database:
        database.execute("UPDATE messages SET data = x'28b52ffd00' WHERE id = 50")
    messages = []
    with open_bag(folder) as bag, pytest.raises(BagError, match=rf"{path.name}.*/tf at \d+"):
        messages.extend(bag)
    assert len(messages) == 110


def test_a_row_without_data_is_an_empty_message(tmp_path):
    folder = write_bag(tmp_path / "made", storage="sqlite3")
    (path,) = folder.glob("*.db3")
    with contextlib.closing(sqlite3.connect(path)) as database, database:
        database.execute("PRAGMA writable_schema = ON")
        database.execute("UPDATE sqlite_schema SET sql = replace(sql, 'BLOB NOT NULL', 'BLOB')")
    with contextlib.closing(sqlite3.connect(path)) as database, database:
        database.execute("UPDATE messages SET data = NULL WHERE id = 50")
    with open_bag(folder) as bag:
        assert sum(message.data == b"" for message in bag) == 1
    assert sum(topic.count for topic in describe_bag(folder).topics) == 111


def test_a_message_that_only_the_metadata_tells_of(tmp_path):
    """Such a file has neither a summary nor checksums: metadata.yaml alone knows the number."""
    folder = shutil.copytree(GOLDEN / "real" / "g_mcap_fastwrite", tmp_path / "copy")
    with open_bag(folder) as bag:
        assert (len(list(bag)), bag.problems) == (223, [])
    (path,) = folder.glob("*.mcap")
    damaged = bytearray(path.read_bytes())
    assert damaged[40188] == 0x05  # a message
    damaged[40188] = 0xFA
    path.write_bytes(damaged)
    with open_bag(folder) as bag:
        assert len(list(bag)) == 222
        assert "222 of 223 messages" in " ".join(bag.problems)


def test_missing_message_is_reported(tmp_path):
    """Without a checksum a damaged opcode looks like a record to be skipped."""
    folder = write_bag(tmp_path / "made", checksums=False)
    (path,) = folder.glob("*.mcap")
    damaged = bytearray(path.read_bytes())
    head = struct.pack("<HIQ", 2, 0, START + 10_000_000 + 1_000_000)[6:]
    damaged[damaged.index(head) - 6 - 9] = 0xFA
    path.write_bytes(damaged)
    messages, complaint = read_what_there_is(folder)
    assert len(messages) == 110
    assert "1 message listed in its statistics is missing" in complaint
    assert "1 message listed in its statistics is missing" in " ".join(
        Buffer.from_bag(folder).bag_report.problems
    )
