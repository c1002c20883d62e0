"""docs/how-to/training_data.md and docs/how-to/rerun.md do what they say."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.how_to import blocks_of
from tests.places import EXAMPLES, HOW_TO, PATH

TRAINING = (HOW_TO / "training_data.md").read_text(encoding="utf-8")
RERUN = (HOW_TO / "rerun.md").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def _in_a_clone(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", PATH)
    (tmp_path / "examples").symlink_to(EXAMPLES, target_is_directory=True)
    monkeypatch.chdir(tmp_path)


def shell(commands):
    done = subprocess.run(
        ["bash", "-ec", commands], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done


@pytest.mark.parametrize(
    ("page", "words"),
    [(TRAINING, ["rosbag to parquet", "rosbag to lerobot dataset"]), (RERUN, ["ros 2 rerun"])],
)
def test_the_search_words_stand_in_the_first_line(page, words):
    title = page.splitlines()[0].lower()
    assert all(each in title for each in words)


def test_the_bags_are_converted_and_read():
    (convert,) = blocks_of(TRAINING, "sh")
    printed, rows = blocks_of(TRAINING, "text")
    assert shell(convert).stdout == printed
    (program,) = blocks_of(TRAINING, "python")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, rows, "")


def test_the_options_and_modules_of_the_page_exist():
    text = (EXAMPLES / "bag_to_lerobot" / "bag_to_lerobot.py").read_text(encoding="utf-8")
    options = re.findall(r'add\(\s*(?:"-o", )?"(--\w+)"', text)
    assert len(options) == 9
    assert set(options) - {"--output", "--robot"} <= set(re.findall(r"--\w+", TRAINING))
    for name in ("aligned", "images", "dataset"):
        assert f"`{name}.py`" in TRAINING
        assert (EXAMPLES / "bag_to_lerobot" / f"{name}.py").exists()


def test_a_bag_becomes_a_file_of_rerun():
    rerun = pytest.importorskip("rerun", reason="the recipe needs Python 3.11")
    (commands,) = blocks_of(RERUN, "sh")
    shell(commands)
    chunks = list(rerun.chunk.RrdReader("arm.rrd").stream())
    assert {"/tf/hand", "/joint_states/elbow"} <= {chunk.entity_path for chunk in chunks}
    live = blocks_of(RERUN, "bash")[1]
    shell(f"{live.strip()} -o live.rrd --seconds 0.5")
    assert Path("live.rrd").stat().st_size > 0


def test_the_table_has_the_types_that_are_logged():
    text = (EXAMPLES / "rerun_log" / "entities.py").read_text(encoding="utf-8")
    types = re.findall(r'"(?:sensor_msgs|tf2_msgs)/msg/(\w+)"', text)
    assert len(set(types)) == 6
    assert all(f"`{name}`" in RERUN for name in types if name != "TFMessage")
