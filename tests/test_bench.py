"""`scripts/bench` tells its names before it sets anything up."""

from __future__ import annotations

import shutil
import subprocess

import pytest
from tests.places import ROOT, SCRIPTS


@pytest.mark.parametrize("words", [["-h"], ["tf_buffer", "--help"]])
def test_help_lists_the_benchmarks_without_a_set_up(tmp_path, words):
    (tmp_path / "scripts").mkdir()  # no scripts/setup there: calling it would fail
    shutil.copy(SCRIPTS / "bench", tmp_path / "scripts")
    shutil.copytree(ROOT / "benchmarks", tmp_path / "benchmarks")
    done = subprocess.run(
        [tmp_path / "scripts/bench", *words], capture_output=True, text=True, check=True
    )
    usage, *rest = done.stdout.splitlines()
    assert usage == "usage: scripts/bench [-h] [NAME ...]"
    names = [line.strip() for line in rest if line.startswith("  ")]
    assert {"bags", "robot_state", "tf_buffer", "turtles"} <= set(names)
    assert "figures" not in names
