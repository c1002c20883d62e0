"""Command lines of `ros2 bag`: exit codes, texts and files of the real one."""

import json
import os
import re
import shutil
import signal
import subprocess

import pytest

from tests import places

from .conftest import ROS2

GOLDEN = places.GOLDEN / "bag"
COMMANDS = json.loads((GOLDEN / "commands.json").read_text())
EXPECTED = {
    row["command"]: row for row in json.loads((GOLDEN / "commands.expected.json").read_text())
}
#: What differs on purpose, and why; see docs/compatibility.md.
DEVIATIONS = json.loads((GOLDEN / "deviations.json").read_text())
ALL_DEVIATIONS = {name for reasons in DEVIATIONS.values() for name in reasons}
#: What is told in addition.
ADDED = {
    "ros2 bag play p_small --topics /unknown --disable-keyboard-controls": (
        "The bag has no topic '/unknown'. Its topics are /a, /b, /latched"
    ),
    "ros2 bag record -o new --topics /nobody_sends --disable-keyboard-controls": (
        "Topic '/nobody_sends' has no publisher"
    ),
    "ros2 bag record -o new -s sqlite3 --compression-mode message --topics /a": (
        "Topic '/a' has no publisher"
    ),
}


def lines_of(text, folder, made):
    """Lines that must be there, in any order: threads log, and topics come out of a hash map."""
    text = re.sub(r"\[\d{9,10}\.\d{6,9}\]", "[T]", text).replace(str(folder), "$WS")
    kept, in_usage = [], False
    for line in text.replace("disabled.[", "disabled.\n[").splitlines():
        if line.startswith("usage: "):
            in_usage = True
        elif in_usage and ": error: " not in line:
            continue
        elif line.strip() and "signal_handler" not in line:
            in_usage = False
            line = re.sub(r"(\(choose from )(.*)\)", sorted_choices, line)  # noqa: PLW2901
            line = re.sub(r"^(Topic information: |\s+)Topic: ", "Topic: ", line)  # noqa: PLW2901
            kept.append(re.sub(r"^Bag size: .*", "Bag size", line) if made else line)
    return sorted(line.rstrip() for line in kept)


def sorted_choices(match):
    return match[1] + ", ".join(sorted(match[2].replace("'", "").split(", "))) + ")"


@pytest.mark.parametrize("case", COMMANDS, ids=[case["command"] for case in COMMANDS])
def test_a_command(case, tmp_path):
    command, expected = case["command"], EXPECTED[case["command"]]
    for name in case.get("needs", []):
        shutil.copytree(GOLDEN / name, tmp_path / name)
    for name, text in case.get("files", {}).items():
        (tmp_path / name).write_text(text)
    path = f"{ROS2.parent}:{os.environ['PATH']}"
    process = subprocess.Popen(
        ["bash", "-c", command],
        cwd=tmp_path,
        env={**os.environ, "PATH": path, "TZ": "UTC", "COLUMNS": "100"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    err = ""
    if "stop_after" in case:
        for line in process.stderr:
            err += line
            if "Recording..." in line:
                break
        os.killpg(process.pid, signal.SIGINT)
        err += process.stderr.read()  # communicate() would lose what has been read ahead
    out, rest = process.communicate(timeout=300)
    made = "convert" in command or "reindex" in command
    assert process.returncode == expected["exit"], err + rest
    assert lines_of(out, tmp_path, made) == lines_of(expected["stdout"], tmp_path, made)
    said, told = lines_of(err + rest, tmp_path, made), lines_of(expected["stderr"], "$WS", made)
    assert (said != told) == (f"{command} stderr" in ALL_DEVIATIONS)
    if command in ADDED:
        assert ADDED[command] in err + rest
    elif said != told:
        assert ": error: " in err + rest
    files = sorted(str(f.relative_to(tmp_path)) for f in tmp_path.rglob("*") if f.is_file())
    assert files == expected["files"]


def test_all_are_here():
    assert len(COMMANDS) == len(EXPECTED) == 24


def test_at_least_97_percent_of_the_texts_are_equal():
    """Of each command exit code, two streams and files; of three bags three texts of three parts.

    Faults of the real one that are mended here do not count.
    """
    named = {name.removesuffix(" stderr") for name in ALL_DEVIATIONS if name.startswith("ros2 ")}
    assert named <= EXPECTED.keys()
    assert len(DEVIATIONS["chosen"]) <= 0.03 * (4 * len(COMMANDS) + 3 * 3 * 3)
