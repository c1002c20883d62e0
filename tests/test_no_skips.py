"""`TURTLEWIRE_NO_SKIPS=1`: a missing requirement that can be installed fails a test."""

from __future__ import annotations

import os
import subprocess
import sys

from tests.places import ROOT

TESTS = """
import pytest

@pytest.mark.skipif(True, reason="only Linux has /proc")
def test_of_a_system(): ...

@pytest.mark.xfail
def test_expected_to_fail(): assert False

def test_of_a_program(): pytest.skip("needs dot (Debian: apt install graphviz)")

def test_of_peers(): pytest.skip("no real ROS 2 in build/peers (run scripts/peers)")

def test_of_a_package(): pytest.importorskip("no_such_package")
"""


MODULE = """
import pytest
pytest.importorskip("no_such_package")
"""


def run_pytest(folder, *, strict):
    """Return the last line of pytest's output, and its exit status."""
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "tests.no_skips", "-c", os.devnull, folder],
        env={**os.environ, "PYTHONPATH": str(ROOT), "TURTLEWIRE_NO_SKIPS": str(int(strict))},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.splitlines()[-1].strip("= ").partition(" in ")[0], done.returncode


def test_a_test_fails_if_what_it_misses_can_be_installed(tmp_path):
    (tmp_path / "test_some.py").write_text(TESTS)
    assert run_pytest(tmp_path, strict=False) == ("4 skipped, 1 xfailed", 0)
    assert run_pytest(tmp_path, strict=True) == ("3 failed, 1 skipped, 1 xfailed", 1)


def test_a_module_fails_if_what_it_misses_can_be_installed(tmp_path):
    (tmp_path / "test_other.py").write_text(MODULE)
    assert run_pytest(tmp_path, strict=False) == ("1 skipped", 5)
    assert run_pytest(tmp_path, strict=True) == ("1 error", 2)
