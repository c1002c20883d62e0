"""Completions of `ros2 bag`, and errors of wrong words."""

import os
from pathlib import Path

import pytest
from tests.places import GOLDEN
from tests.programs import offered, run_python

import ros2cli.main

SMALL = GOLDEN / "bag" / "p_small"
REST = "must be greater than 0 when snapshot mode is enabled\n"


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2 bag re", {"record", "reindex"}),
        ("ros2 bag record --storage-preset-profile zstd_", {"zstd_fast", "zstd_small"}),
        ("ros2 bag play --clock-topics-", {"--clock-topics-all"}),
        (f"ros2 bag play {SMALL} --topics /l", {"/latched", "/lossy"}),
        ("ros2 bag record --topic-types std_msgs/msg/UInt8", None),
    ],
)
def test_completion(line, expected):
    words = offered(line)
    assert words == expected if expected else "std_msgs/msg/UInt8MultiArray" in words


@pytest.mark.parametrize(
    ("words", "status", "answer"),
    [
        ("pla", 2, "Did you mean: play"),
        ("record --topcs /a", 2, "Did you mean: --topics"),
        ("record -e (", 1, "'(' is not a regular expression"),
        ("record --topics /a --custom-data x", 2, "'x' is not of the form KEY=VALUE"),
        ("record --topics /a -b 5", 1, "Please provide a value greater than 1024"),
        ("record --topics /a --exclude-topics /b", 1, "--exclude-topics argument requires either"),
        ("record -a --storage-config-file c.yaml", 1, "c.yaml: unknown key 'chunksize'"),
        ("play SMALL -r fast", 2, "fast is not the valid type (float)"),
        ("play SMALL -m /a", 1, "'/a' is not of the form OLD:=NEW"),
        ("play SMALL --qos-profile-overrides-path q.yaml", 1, "Unexpected key `reliabilty`"),
        ("convert -i SMALL -o c.yaml", 1, "the key 'output_bags' with a list is missing"),
        ("convert -i SMALL -o o.yaml", 1, "unknown key 'topcs'\nDid you mean: topics"),
        ("convert -i SMALL -o t.yaml", 1, "t.yaml: start_time_ns is of type int, not 'abc'"),
        ("convert -i SMALL -o p.yaml", 1, "topic_polling_interval is a number of ms, not 'fast'"),
        ("record --topics /a --node-name a-b", 1, "'a-b' cannot be the name of a node"),
        ("record --topics /a --snapshot-mode --max-cache-size 0", 1, "Max cache size must be"),
        ("record -a --storage-preset-profile resilient", 1, "unknown MCAP storage preset profile"),
        ("record -a -o file/bag", 1, "cannot make the bag"),
        ("burst SMALL -n -3", 2, "value must be non-negative integer"),
    ],
)
def test_wrong_words(words, status, answer, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    Path("c.yaml").write_text("chunksize: 3\n")
    Path("q.yaml").write_text("/a:\n  reliabilty: reliable\n")
    Path("o.yaml").write_text("output_bags:\n- uri: o\n  topcs: [/a]\n")
    Path("t.yaml").write_text("output_bags:\n- {uri: o, start_time_ns: abc}\n")
    Path("p.yaml").write_text("output_bags:\n- {uri: o, topic_polling_interval: fast}\n")
    Path("file").write_text("")
    before = set(Path().iterdir())
    try:
        found = ros2cli.main.main(["bag", *words.replace("SMALL", str(SMALL)).split()])
    except SystemExit as end:
        found = end.code
    assert (found, answer in capfd.readouterr().err) == (status, True)
    assert set(Path().iterdir()) == before  # no folder is begun


@pytest.mark.parametrize(
    ("distro", "answer"),
    [
        ("kilted", f"Max cache size {REST}"),
        ("lyrical", f"Either the max cache size or the maximum cache duration {REST}"),
    ],
)
def test_a_snapshot_needs_a_limit(distro, answer, tmp_path):
    words = ["bag", "record", "--topics", "/a", "--snapshot-mode", "--max-cache-size", "0"]
    code = f"import sys; from ros2cli.main import main; sys.exit(main({words}))"
    done = run_python(
        code, check=False, timeout=60, env={**os.environ, "ROS_DISTRO": distro}, cwd=tmp_path
    )
    assert (done.returncode, done.stderr) == (1, answer)
    assert list(tmp_path.iterdir()) == []
