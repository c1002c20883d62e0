"""The examples of `docs/api.md` give the answers on the page."""

from __future__ import annotations

import doctest
import subprocess
import sys

from tests.how_to import blocks_of
from tests.places import ROOT
from tests.programs import run_python


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
