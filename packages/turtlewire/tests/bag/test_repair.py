"""Bags that a crash or a full disk cut off are repaired; half-written folders are removed."""

import os
import random
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags.rosbag2 import Reader
from tests.bags import START
from tests.disks import full_disk

from ros2cli.main import main
from turtlewire.bag import BagWriter, open_bag, reindex
from turtlewire.bag.compression import write_zstd_file
from turtlewire.bag.unfinished import new_folder
from turtlewire.errors import BagError
from turtlewire.msg import get_message
from turtlewire.wire.qos import Durability, QoS

String = get_message("std_msgs/msg/String")
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)


def written(path, storage, count=1000, **options):
    """A bag without metadata.yaml; returns its file."""
    kept = {"ros_distro": "jazzy", "custom_data": {"robot": "r1"}, **options}
    with BagWriter(path, storage=storage, chunk_bytes=5000, **kept) as writer:
        writer.add_topic("/a", "std_msgs/msg/String", qos=[LATCHED])
        for number in range(count):
            writer.write("/a", String(data=f"{number} " + "x" * 50), START + number)
    os.remove(path / "metadata.yaml")
    (file,) = path.iterdir()
    return file


def numbers(path):
    """The numbers in the messages that can be read."""
    found = []
    with open_bag(path) as bag, suppress(BagError):  # raised after what can be read
        found.extend(int(each.decode().data.split()[0]) for each in bag)
    return found


@pytest.mark.parametrize(
    ("storage", "options"),
    [
        ("mcap", {}),
        ("mcap", {"compression": "zstd"}),
        ("mcap", {"compression": "lz4"}),
        ("sqlite3", {}),
        ("sqlite3", {"compression_mode": "MESSAGE"}),
    ],
)
@pytest.mark.parametrize("share", [0.4, 0.65, 0.97])
def test_a_cut_bag_is_made_whole(tmp_path, storage, options, share):
    path = tmp_path / "bag"
    file = written(path, storage, **options)
    whole = file.read_bytes()
    file.write_bytes(whole[: int(len(whole) * share)])
    before = numbers(path)
    assert before == list(range(len(before)))
    assert 0 < len(before) <= 1000
    told = []
    metadata = reindex(path, told.append)
    assert metadata.message_count == len(before)
    assert any(f"the damaged file is {file}.damaged" in each for each in told)
    assert Path(f"{file}.damaged").read_bytes() == whole[: int(len(whole) * share)]
    with open_bag(path) as bag:
        assert bag.problems == []
        assert [qos.durability for qos in bag.topics["/a"].qos] == [Durability.TRANSIENT_LOCAL]
        assert "std_msgs/msg/String" in bag.definitions()
        assert (bag.metadata.ros_distro, bag.metadata.custom_data) == ("jazzy", {"robot": "r1"})
    assert numbers(path) == before
    with Reader(path) as reader:  # the judge: it takes only whole files
        assert len(list(reader.messages())) == len(before)
    told.clear()
    reindex(path, told.append)
    assert told == []


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_copy_that_a_killed_repair_left_is_replaced(tmp_path, storage):
    path = tmp_path / "bag"
    file = written(path, storage)
    left_over = file.read_bytes()
    file.write_bytes(left_over[: len(left_over) // 2])
    before = numbers(path)
    Path(f"{file}.repaired.part").write_bytes(left_over)
    assert 0 < len(before) < 1000
    assert reindex(path).message_count == len(before)
    assert numbers(path) == before
    names = {file.name, f"{file.name}.damaged", "metadata.yaml"}
    assert {each.name for each in path.iterdir()} == names


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_copy_that_a_killed_recorder_left_is_removed(tmp_path, storage):
    path = tmp_path / "bag"
    file = written(path, storage, 10)
    for ending in (".part", ".zstd.part"):
        Path(f"{file}{ending}").write_bytes(b"unfinished")
    other = path / "notes.part"
    other.touch()
    assert reindex(path).message_count == 10
    assert set(path.iterdir()) == {file, path / "metadata.yaml", other}


def test_a_file_instead_of_a_folder_is_refused_with_the_folder(tmp_path):
    file = written(tmp_path / "bag", "mcap", 10)
    with pytest.raises(BagError, match="is a file\n") as refused:
        reindex(file)
    assert refused.value.hint == f"Pass the folder of the bag: reindex('{tmp_path / 'bag'}')"


def test_a_file_that_is_there_twice_is_read_once(tmp_path):
    file = written(tmp_path / "bag", "mcap", 10)
    write_zstd_file(str(file), f"{file}.zstd")  # and the recorder was killed before it removed it
    assert reindex(tmp_path / "bag").message_count == 10
    assert numbers(tmp_path / "bag") == list(range(10))
    file.unlink()
    assert reindex(tmp_path / "bag").message_count == 10


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_damage_of_a_compressed_file_names_the_file(tmp_path, storage):
    file = written(tmp_path / "bag", storage, 5000, compression_mode="FILE")
    whole = file.read_bytes()
    file.write_bytes(whole[:-10])
    told = []
    reindex(tmp_path / "bag", told.append)
    assert len(told) == 2
    assert all(each.startswith(f"{file}: ") for each in told)
    file.write_bytes(whole[:100])
    with pytest.raises(BagError, match=f"^{file} is neither .*, as far as it was decompressed$"):
        open_bag(file)


def test_channels_in_other_encodings_are_repaired(tmp_path):
    (tmp_path / "bag").mkdir()
    file = tmp_path / "bag" / "bag_0.mcap"
    with file.open("wb") as out:
        writer = McapWriter(out, chunk_size=1, compression=CompressionType.ZSTD)
        writer.start("", "test")
        schemas = {"/pose": writer.register_schema("demo.Pose", "jsonschema", b"{}"), "/free": 0}
        for topic, schema in schemas.items():
            channel = writer.register_channel(topic, "json", schema)
            for time in range(10):
                writer.add_message(channel, log_time=time, publish_time=time, data=b"{}")
        writer.finish()
    file.write_bytes(file.read_bytes()[:-1000])
    reindex(tmp_path / "bag")
    assert Path(f"{file}.damaged").exists()
    with file.open("rb") as repaired:
        found = [
            (channel.topic, channel.message_encoding, schema and (schema.name, schema.encoding))
            for schema, channel, message in make_reader(repaired).iter_messages()
            if message.data == b"{}"
        ]
    pose, free = ("/pose", "json", ("demo.Pose", "jsonschema")), ("/free", "json", None)
    assert sorted(found, key=str) == [*[free] * 10, *[pose] * 10]


def test_a_whole_bag_is_not_rewritten(tmp_path):
    file = written(tmp_path / "bag", "mcap")
    before = file.read_bytes()
    assert main(["bag", "reindex", str(tmp_path / "bag")]) == 0
    assert file.read_bytes() == before
    assert {each.name for each in (tmp_path / "bag").iterdir()} == {file.name, "metadata.yaml"}


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_without_room_the_damaged_file_stays(tmp_path, storage, capfd):
    with BagWriter(tmp_path / "bag", storage=storage, chunk_bytes=5000) as writer:
        noise = random.Random(1)
        for number in range(100):
            writer.write("/a", String(data=noise.randbytes(2000).hex()), START + number)
    os.remove(tmp_path / "bag" / "metadata.yaml")
    (file,) = (tmp_path / "bag").iterdir()
    damaged = file.read_bytes()[:-100_000]
    file.write_bytes(damaged)
    with full_disk(100_000):
        assert main(["bag", "reindex", str(tmp_path / "bag")]) == 0
    assert f"{file} is not repaired: [Errno " in capfd.readouterr().err
    assert file.read_bytes() == damaged
    assert {each.name for each in (tmp_path / "bag").iterdir()} == {file.name, "metadata.yaml"}


def test_a_cut_file_says_how_much_is_missing(tmp_path):
    for storage, text in (("mcap", "the last "), ("sqlite3", "its last ")):
        file = written(tmp_path / storage, storage)
        file.write_bytes(file.read_bytes()[:-9_000])
        with open_bag(tmp_path / storage) as bag:
            assert text in bag.problems[0]
            assert " bytes" in bag.problems[0]


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_mutated_bags_are_repaired_or_refused(tmp_path, storage):
    path = tmp_path / "bag"
    file = written(path, storage, 200)
    whole = file.read_bytes()
    generator = random.Random(storage)
    repaired = 0
    for _ in range(60):
        for old in path.iterdir():
            old.unlink()
        data = bytearray(whole)
        for _ in range(generator.randint(1, 4)):
            at = generator.randrange(100 if storage == "sqlite3" else 8, len(data))
            if generator.random() < 0.3:
                del data[at:]
            else:
                data[at : at + 1] = generator.randbytes(1)
            if len(data) < 200:
                break
        file.write_bytes(data)
        try:
            metadata = reindex(path)
        except BagError:
            continue
        repaired += 1
        with open_bag(path) as bag:
            assert len(bag) == metadata.message_count
    assert repaired > 20


locks = pytest.mark.skipif(sys.platform == "win32", reason="Windows does not lock folders")

WRITER = """
import os, sys
from turtlewire.bag.unfinished import new_folder
with new_folder(sys.argv[1]) as path:
    os.mkdir(path)
    print("ready", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def writer(tmp_path):
    """A process that has begun to write the folder ``out``."""
    command = [sys.executable, "-c", WRITER, str(tmp_path / "out")]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    yield process
    process.kill()
    process.communicate()


def write(path):
    with new_folder(path) as scratch:
        (path.parent / scratch).mkdir()


def parts(tmp_path):
    return sorted(each.name for each in tmp_path.iterdir() if each.name.endswith(".part"))


@locks
def test_the_next_run_removes_what_a_killed_process_has_left(tmp_path, writer):
    writer.kill()
    writer.communicate()
    assert len(parts(tmp_path)) == 1
    (tmp_path / ".out.mine.part").mkdir()  # not one of ours
    (tmp_path / ".other.1-2.part").mkdir()  # of another folder
    write(tmp_path / "out")
    assert (tmp_path / "out").is_dir()
    assert parts(tmp_path) == [".other.1-2.part", ".out.mine.part"]


@locks
def test_the_folder_of_a_living_process_is_left_alone(tmp_path, writer):
    (left,) = parts(tmp_path)
    write(tmp_path / "out")
    assert parts(tmp_path) == [left]
    assert (tmp_path / left / "out").is_dir()
    writer.communicate("")
    assert writer.returncode == 1  # `out` exists by now
    assert parts(tmp_path) == []


@locks
def test_threads_do_not_remove_each_others_folders(tmp_path):
    begun, done = threading.Event(), threading.Event()

    def first():
        with new_folder(tmp_path / "out") as scratch:
            (tmp_path / scratch).mkdir()
            begun.set()
            assert done.wait(60)

    thread = threading.Thread(target=first)
    thread.start()
    try:
        assert begun.wait(60)
        with suppress(RuntimeError), new_folder(tmp_path / "out"):
            assert len(parts(tmp_path)) == 2
            raise RuntimeError("stop")
        assert len(parts(tmp_path)) == 1
    finally:
        done.set()
        thread.join()
    assert (tmp_path / "out").is_dir()


@locks
def test_a_link_is_not_followed(tmp_path):
    (tmp_path / "precious").mkdir()
    (tmp_path / ".out.1-2.part").symlink_to(tmp_path / "precious")
    write(tmp_path / "out")
    assert (tmp_path / "precious").is_dir()
