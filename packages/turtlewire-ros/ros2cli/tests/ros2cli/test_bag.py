"""``ros2 bag``: texts and exit codes of the real one."""

import json
import shutil

import pytest
from tests.programs import run_python

import ros2cli.main
from tests import places

GOLDEN = places.GOLDEN / "bag"
BAGS = ["d_mcap", "d_split_file_zstd", "d_sqlite3_message_zstd"]

#: The real one cannot count in compressed bags: it fails, or finds no requests. We count.
MENDED = json.loads((GOLDEN / "deviations.json").read_text())["mended faults"]


@pytest.fixture(autouse=True)
def utc(monkeypatch):
    import time

    monkeypatch.setenv("TZ", "UTC")
    time.tzset()
    yield
    monkeypatch.undo()
    time.tzset()


def run(capfd, *words):
    try:
        status = ros2cli.main.main(["bag", *words])
    except SystemExit as end:
        status = end.code
    out, err = capfd.readouterr()
    return status, out, err


@pytest.mark.parametrize("bag", BAGS)
@pytest.mark.parametrize(("key", "options"), [("info", []), ("info_v", ["-v"]), ("info_t", ["-t"])])
def test_info(capfd, bag, key, options):
    expected = json.loads((GOLDEN / "reads.json").read_text())[bag]["texts"][key]
    status, out, err = run(capfd, "info", *options, str(GOLDEN / bag))
    equal = {
        "exit": status == expected["exit"],
        "stdout": sorted(out.splitlines()) == sorted(expected["stdout"].splitlines()),
        "stderr": err == expected["stderr"],
    }
    command = " ".join(("info", *options, bag))
    assert [part for part in equal if not equal[part]] == [
        part for part in equal if f"{command} {part}" in MENDED
    ]
    if not equal["stdout"]:
        assert "| Request Count: " in out
        assert "Request Count: 0" not in out


def test_info_of_a_single_file(capfd):
    path = GOLDEN / "p_small" / "p_small_0.mcap"
    _, out, _ = run(capfd, "info", str(path))
    assert f"Files:             {path}\n" in out
    assert "Messages:          41\n" in out


def test_reindex(capfd, tmp_path):
    shutil.copytree(GOLDEN / "p_small", tmp_path / "again")
    (tmp_path / "again" / "metadata.yaml").unlink()
    status, _, err = run(capfd, "reindex", str(tmp_path / "again"))
    assert status == 0
    assert f'Beginning reindexing bag in directory: "{tmp_path / "again"}"' in err
    assert err.splitlines()[-1].endswith("[rosbag2_cpp]: Reindexing complete.")
    status, out, _ = run(capfd, "info", str(tmp_path / "again"))
    assert (status, "Messages:          41\n" in out) == (0, True)


def test_reindex_says_what_is_damaged_and_what_was_kept(capfd, tmp_path):
    shutil.copytree(GOLDEN / "d_mcap", tmp_path / "cut")
    with open(tmp_path / "cut" / "d_mcap_0.mcap", "r+b") as file:
        file.truncate(60_000)
    shutil.copytree(GOLDEN / "d_split_file_zstd", tmp_path / "split")
    with open(tmp_path / "split" / "d_split_file_zstd_1.mcap.zstd", "r+b") as file:
        file.truncate(15_000)
    status, _, err = run(capfd, "reindex", str(tmp_path / "cut"))
    assert status == 0
    assert "d_mcap_0.mcap: the record at byte 567 is cut off or damaged" in err
    assert "The bag is damaged; kept: 141 messages in 1 file." in err
    status, _, err = run(capfd, "reindex", str(tmp_path / "split"))
    assert "d_split_file_zstd_1.mcap.zstd: the compressed file ends too early" in err
    assert "this file is left out" in err
    assert "kept: 258 messages in 1 file." in err
    _, out, _ = run(capfd, "info", str(tmp_path / "cut"))
    assert "d_mcap_0.mcap\n" in out


def test_wrong_words(capfd):
    status, out, err = run(capfd, "info", "nothing_here")
    assert (status, out) == (2, "")
    assert err.endswith(
        "ros2 bag info: error: argument bag_path: Bag path 'nothing_here' does not exist!\n"
    )
    file = str(GOLDEN / "p_small" / "p_small_0.mcap")
    assert run(capfd, "reindex", file) == (
        1,
        "",
        "[ERROR] [ros2bag]: Must specify a bag directory\n",
    )
    assert run(capfd, "list", "storage") == (0, "mcap\nsqlite3\n", "")
    assert run(capfd, "info", __file__)[0] == 1


def test_info_is_quick_to_start():
    """No NumPy and no middleware for a look at a file."""

    code = (
        "import sys, ros2cli.main\n"
        f"ros2cli.main.main(['bag', 'info', {str(GOLDEN / 'p_small')!r}])\n"
        "print([m for m in ('numpy', 'turtlewire.wire.cyclone') if m in sys.modules])\n"
    )
    done = run_python(code)
    assert done.stdout.splitlines()[-1] == "[]"
