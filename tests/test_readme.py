"""The README: its Python session runs, and its links and ROS names exist."""

import contextlib
import doctest
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.how_to import blocks_of
from tests.places import LEARNING, ROOT
from tests.programs import run_python

import turtlewire
from turtlewire_ros.executables import executable_paths

FRONT = ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md")
PAGES = [*(ROOT / name for name in FRONT), *sorted((ROOT / "docs").rglob("*.md"))]


def test_its_python_session(monkeypatch):
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    monkeypatch.setenv("TURTLEWIRE_PORT", "0")
    show = turtlewire.show
    with contextlib.ExitStack() as views:
        monkeypatch.setattr(
            turtlewire, "show", lambda buffer: views.enter_context(show(buffer)), raising=False
        )
        failed, tried = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
        assert (failed, tried) == (0, 8)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        assert (page.parent / target).exists(), target


def test_named_programs_exist():
    pages = (ROOT / "README.md", ROOT / "docs" / "install.md")
    text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    runs = re.findall(r"^ros2 run (\w+) (\w+)", text, re.MULTILINE)
    launches = re.findall(r"^ros2 launch (\w+) (\S+)", text, re.MULTILINE)
    assert runs == [("turtlesim", "turtle_teleop_key")]
    assert launches == [(LEARNING.name, "turtle_tf2_demo.launch.py")]
    for package, executable in runs:
        assert executable in [Path(path).name for path in executable_paths(package)]
    for _, launch_file in launches:
        assert list(LEARNING.rglob(launch_file))


# The examples of `docs/api.md` give the answers on the page.


def test_its_examples(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    monkeypatch.setenv("TURTLEWIRE_PORT", "0")
    failed, tried = doctest.testfile(str(ROOT / "docs" / "api.md"), module_relative=False)
    assert failed == 0
    assert tried >= 85


def test_its_two_programs_meet():
    text = (ROOT / "docs" / "api.md").read_text()
    sender, receiver = (each for each in blocks_of(text, "python") if not each.startswith(">>>"))
    with subprocess.Popen([sys.executable, "-c", sender]) as sending:
        try:
            found = run_python(receiver, check=False, timeout=120)
        finally:
            sending.kill()
    assert (found.stdout, found.stderr) == ("hello (1.0, 2.0, 0.0)\n", "")
