"""`turtlewire bag info`, `cut`, `filter`, `merge` and `split` as typed."""

from __future__ import annotations

import json
import math
import os
import resource
import signal
import subprocess
import sys

import pytest
from tests.bags import START, transform, write_bag

from ros2cli.main import main as ros2
from turtlewire import msg
from turtlewire.bag import BagWriter, describe_bag, open_bag
from turtlewire.errors import BagError

from ..bag.conftest import GOLDEN
from .test_bags import run


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_bag(tmp_path / "in", compression="zstd", chunk_bytes=2000)
    return tmp_path


def test_info_shows_topics_rates_and_sizes(capsys, folder):
    done = run(capsys, "bag", "info", "in")
    assert done.status == 0
    lines = done.out.splitlines()
    assert lines[0].startswith("in: mcap zstd, 1 file, ")
    assert lines[0].endswith(" KiB, 111 messages")
    assert lines[1].startswith("0.991 s, from 20")
    assert [line.split() for line in lines[2:]] == [
        ["topic", "messages", "rate", "size", "share", "type"],
        ["/tf", "100", "100.0", "Hz", "9.8", "KiB", "97.3%", "tf2_msgs/msg/TFMessage"],
        ["/chatter", "10", "10.0", "Hz", "179", "B", "1.7%", "std_msgs/msg/String"],
        ["/tf_static", "1", "latched", "100", "B", "1.0%", "tf2_msgs/msg/TFMessage"],
    ]
    found = json.loads(run(capsys, "bag", "info", "in", "--json").out)
    assert found["count"] == 111
    assert [topic["name"] for topic in found["topics"]] == ["/tf", "/chatter", "/tf_static"]


@pytest.mark.parametrize("name", ["d_mcap", "d_split_file_zstd", "d_sqlite3_message_zstd"])
def test_sizes_of_real_bags(name):
    found = describe_bag(GOLDEN / name)
    sizes: dict[str, int] = {}
    with open_bag(GOLDEN / name) as bag:
        for message in bag:
            sizes[message.topic] = sizes.get(message.topic, 0) + len(message.data)
        counts = {topic.name: topic.message_count for topic in bag.metadata.topics}
    assert {topic.name: topic.count for topic in found.topics} == counts
    if "message" not in name:
        for topic in found.topics:
            # Definitions between messages count with the message before them.
            assert sizes.get(topic.name, 0) <= topic.data_bytes <= sizes.get(topic.name, 0) + 20_000


def test_damage_and_missing_definitions_are_shown(capsys, folder):
    with BagWriter("odd") as writer:
        writer.add_topic("/x", "no_msgs/msg/X\x1b", definition=("", ""), hash_of_type="")
        writer.add_topic("/y", "", definition=("ros2msg", ""), hash_of_type="")
        writer.add_topic("/empty", "std_msgs/msg/Empty")  # defined by no characters
        for number in range(300):
            writer.write("/x", bytes(5000), START + number)
    os.remove("odd/metadata.yaml")
    with open("odd/odd_0.mcap", "r+b") as file:
        file.truncate(1_000_000)
    done = run(capsys, "bag", "info", "odd")
    assert "without definitions in the bag: (no type), no_msgs/msg/X\\x1b\n" in done.out
    assert "damaged: odd/odd_0.mcap: " in done.out


def test_a_part_is_usable_alone(capsys, folder):
    words = ["bag", "cut", "in", "-o", "part", "--from", "200ms", "--to", "500ms", "--tf-at-start"]
    done = run(capsys, *words)
    assert (done.status, done.out, done.err) == (0, "part: 34 messages, 0.291 s\n", "")
    assert run(capsys, "bag", "tf", "part").out.splitlines()[2:] == [
        "odom",
        "└─ base_link  100.0 Hz       30  1700000000.200  1700000000.490",
        "   └─ camera    static",
    ]
    assert ros2(["bag", "info", "part"]) == 0
    assert "Messages:          34" in capsys.readouterr().out


def test_other_verbs(capsys, folder):
    done = run(
        capsys,
        *[
            "bag",
            "filter",
            "in",
            "-o",
            "few",
            "--exclude",
            "/tf",
            "--rename",
            "/chatter:=/c",
            "--storage",
            "sqlite3",
        ],
    )
    assert (done.status, done.out) == (0, "few: 11 messages, 0.991 s\n")
    assert (folder / "few" / "few_0.db3").exists()
    done = run(capsys, *["bag", "split", "in", "-o", "parts", "--every", "400ms"])
    assert [line.split(":")[0] for line in done.out.splitlines()] == [
        f"parts/parts_{number}" for number in range(3)
    ]
    done = run(
        capsys,
        *["bag", "merge", "parts/parts_0", "few", "-o", "both", "--rename-frame", "odom:=r/odom"],
    )
    assert done.status == 0
    with open_bag("both") as bag:
        frames = {t.header.frame_id for m in bag.messages("/tf") for t in m.decode().transforms}
    assert frames == {"r/odom"}


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("bag cutt in", "Did you mean: cut"),
        ("bag cut in -o out", "expected --from, --to or both"),
        ("bag split in -o out", "expected --every, --size or --at"),
        ("bag split in -o out --evry 1s", "Did you mean: --every"),
        ("bag split in -o out --every 1s --size 1GB", "not allowed with"),
        ("bag split in -o out --every 10", "'10' is not a length of time: write one like 60s"),
        ("bag split in -o out --size big", "'big' is not a size: write one like 500MB"),
        ("bag filter in -o out --rename-frame a=b", "'a=b' is not of the form OLD:=NEW"),
        ("bag filter in -o out --topic /chater", "Did you mean: /chatter"),
        ("bag filter in -o in", "in: a bag needs a new folder"),
        ("bag merge in nope -o out", "there is no bag at nope"),
        ("bag cut in -o no/such/out --to 1s", "no/such/out: No such file or directory"),
    ],
)
def test_mistakes_leave_nothing(capsys, folder, words, text):
    done = run(capsys, *words.split())
    assert done.status == 2
    assert text in done.err
    assert os.listdir(folder) == ["in"]


@pytest.mark.parametrize("verb", ["info", "cut", "filter", "merge", "split"])
def test_help_has_an_example(capsys, verb):
    done = run(capsys, "bag", verb, "--help")
    assert f"Example: turtlewire bag {verb} " in " ".join(done.out.split())


def test_damage_is_reported_with_status_1(capsys, folder):
    os.remove("in/metadata.yaml")
    with open("in/in_0.mcap", "r+b") as file:
        file.truncate(7000)
    done = run(capsys, *["bag", "filter", "in", "-o", "out"])
    assert done.status == 1
    assert done.out.startswith("out: ")
    assert "in/in_0.mcap: " in done.err


@pytest.mark.skipif(sys.platform == "win32", reason="limits of Unix")
def test_a_full_disk_is_one_line(folder):
    text = msg.get_message("std_msgs/msg/String")(data="x" * 100_000)
    with BagWriter("big") as writer:
        for number in range(30):
            writer.write("/a", text, START + number)
    program = "import sys; from turtlewire.cli.main import main; sys.exit(main())"
    words = ["bag", "filter", "big", "-o", "out", "--compression", "file"]
    done = subprocess.run(
        [sys.executable, "-c", program, *words],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1_000_000, 1_000_000)),
    )
    assert done.returncode == 1
    assert done.stderr == (
        f"turtlewire bag filter: {folder / 'out'}: File too large; what was written is removed\n"
    )
    assert sorted(os.listdir(folder)) == ["big", "in"]


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_ctrl_c_leaves_nothing(folder):
    with BagWriter("big", chunk_bytes=1000) as writer:
        for number in range(20_000):
            writer.write("/tf", transform(number), START + number)
    program = (
        "import sys, os\n"
        "from turtlewire.cli.main import main\n"
        "from turtlewire.bag.writer import BagWriter\n"
        "append = BagWriter.append\n"
        "def told(*args):\n"
        "    print('writing', flush=True)\n"
        "    BagWriter.append = append\n"
        "    return append(*args)\n"
        "BagWriter.append = told\n"
        "sys.exit(main())\n"
    )
    words = ["bag", "filter", "big", "-o", "out", "--rename-frame", "odom:=o"]
    process = subprocess.Popen(
        [sys.executable, "-c", program, *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout.readline() == "writing\n"
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=120)
    assert process.returncode == 130
    assert said == "turtlewire bag filter: interrupted; out was not written\n"
    assert sorted(os.listdir(folder)) == ["big", "in"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [("1m20s", 80_000_000_000), ("1.5h", 5_400_000_000_000), ("250ms", 250_000_000)],
)
def test_lengths_of_time(text, expected):
    from turtlewire.bag.times import duration_ns

    assert duration_ns(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "2023-11-14T22:13:20.5Z",
        "2023-11-14 23:13:20.500+01:00",
        "2023-11-14T22:13:20.5+0000",
        "1700000000500000000",
        "500ms",
    ],
)
def test_times(text):
    from turtlewire.bag.times import date_text, moment_ns

    assert moment_ns(text, START) == START + 500_000_000
    assert moment_ns(date_text(START + 7), 0) == START + 7


@pytest.mark.parametrize(
    ("text", "expected"), [("1GB", 10**9), ("512MiB", 512 << 20), ("100k", 100_000), ("7", 7)]
)
def test_sizes(text, expected):
    from turtlewire.bag.times import size_bytes

    assert size_bytes(text) == expected


@pytest.mark.parametrize(
    ("size", "error"),
    [("1XB", BagError), (f"{'9' * 400}TB", BagError), (1.5, TypeError), (math.nan, TypeError)],
)
def test_wrong_sizes_are_rejected(size, error):
    from turtlewire.bag.times import size_bytes

    with pytest.raises(error):
        size_bytes(size)
