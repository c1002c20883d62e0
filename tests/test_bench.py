"""The benchmarks: their names, and that they run with the API as it is."""

import json
import shutil
import subprocess
import sys

import pytest
from benchmarks.tf_buffer import CASES
from tests.places import ROOT, SCRIPTS, TOOLS


@pytest.mark.parametrize("words", [["-h"], ["tf_buffer", "--help"]])
def test_help_lists_the_benchmarks_without_a_set_up(tmp_path, words):
    (tmp_path / "scripts").mkdir()  # no scripts/setup there: calling it would fail
    shutil.copy(SCRIPTS / "bench", tmp_path / "scripts")
    shutil.copytree(ROOT / "benchmarks", tmp_path / "benchmarks")
    done = subprocess.run(
        [tmp_path / "scripts/bench", *words], capture_output=True, text=True, check=True
    )
    usage, *rest = done.stdout.splitlines()
    assert usage == "usage: scripts/bench [-h] [--against real | NAME ...]"
    names = [line.strip() for line in rest if line.startswith("  ")]
    assert {"bags", "robot_state", "tf_buffer", "turtles"} <= set(names)
    assert "figures" not in names


@pytest.mark.slow
def test_the_figures_of_the_buffer_are_measured():
    adapter = ROOT / "benchmarks" / "rivals" / "turtlewire_buffer.py"
    done = subprocess.run([sys.executable, adapter], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    figures = json.loads(done.stdout)
    measured = {case for _, case, *_ in CASES}
    assert measured <= figures.keys()
    assert all(min(figure) > 0 for figure in figures.values())


# `scripts/soak` for a minute: the processes that stay neither grow nor end.


SOAK = TOOLS / "soak.py"


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="it measures with Linux's /proc")
def test_a_minute(run):
    program = run(sys.executable, SOAK, "--minutes", "1")
    assert program.wait(500) == 0, program.text
    (said,) = program.wait_for(r"^visitors: (\d+), of them killed: (\d+)$")
    come, killed = map(int, said.groups())
    assert killed >= come // 3
