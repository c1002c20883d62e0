"""Generating the Python modules of interfaces in a build: silently, or with the faulty line."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("std_msgs/Header[<=2] a\nuint8 K=1 # nope_msgs/X\n", (0, "")),
        ("nope_msgs/X x\n", (1, "some_msgs/msg/A, line 1: there is no nope_msgs/msg/X in ")),
        ("std_msgs/Nope[2] x\n", (1, "some_msgs/msg/A, line 1: there is no std_msgs/msg/Nope in ")),
    ],
)
def test_all_types_must_be_there(tmp_path, text, expected):
    (tmp_path / "defined/msg").mkdir(parents=True)
    (tmp_path / "defined/msg/A.msg").write_text(text)
    command = [sys.executable, "-m", "turtlewire_ros.generate_interfaces", "defined"]
    done = subprocess.run(
        [*command, "--output", "made", "--package", "some_msgs"],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (expected[0], "")
    assert done.stderr.startswith(expected[1])
    assert bool(done.stderr) == bool(expected[0])
