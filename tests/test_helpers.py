"""Helpers of the tests: archives of small files, and skips that CI forbids.

`TURTLEWIRE_NO_SKIPS=1`: a missing requirement that can be installed fails a test.
"""

import os
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.archive import Entry
from tests.places import ROOT

from tests import archive

NAMES = st.from_regex(r"[a-z0-9_./-]{1,20}", fullmatch=True)
LINES = st.lists(st.sampled_from([b"a", b"", b"====", b"==== a", b"\r", b"\xff\x00", b"a ===="]))


@given(st.dictionaries(NAMES, st.builds(Entry, LINES.map(b"\n".join), st.booleans()), min_size=1))
def test_each_byte_is_kept(tmp_path_factory, entries):
    path = tmp_path_factory.mktemp("archive") / "archive.txt"
    path.write_bytes(archive.write(entries))
    assert archive.read(path) == entries


def test_a_folder_is_packed_and_unpacked(tmp_path):
    source = tmp_path / "source"
    (source / "bin").mkdir(parents=True)
    (source / "bin" / "run").write_text("#!/bin/sh")
    (source / "bin" / "run").chmod(0o755)
    (source / "empty").touch()
    (source / "notes.txt").write_text("a\n\n")
    path = tmp_path / "archive.txt"
    command = [sys.executable, archive.__file__]
    path.write_bytes(subprocess.check_output([*command, "pack", source]))
    assert path.read_text() == (
        "==== bin/run (executable) (no newline at the end) ====\n#!/bin/sh\n"
        "==== empty ====\n==== notes.txt ====\na\n\n"
    )
    subprocess.check_call([*command, "unpack", path, tmp_path / "again"])
    assert archive.pack(tmp_path / "again") == path.read_bytes()
    archive.unpack(path, tmp_path / "part", "bin/")
    assert archive.pack(tmp_path / "part").startswith(b"==== run (executable)")


def test_entry_that_looks_like_two_is_refused(tmp_path):
    for entries in ({"a b": Entry(b"")}, {"a": Entry(b"c\n==== b ====")}):
        with pytest.raises(ValueError, match="does not fit"):
            archive.write(entries)
    path = tmp_path / "archive.txt"
    for text in ("", "a\n==== a ====\n"):
        path.write_text(text)
        with pytest.raises(ValueError, match="does not begin"):
            archive.read(path)
    path.write_text("==== a ====\n==== a ====\n")
    with pytest.raises(ValueError, match="twice"):
        archive.read(path)


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


@pytest.mark.slow
def test_a_test_fails_if_what_it_misses_can_be_installed(tmp_path):
    (tmp_path / "test_some.py").write_text(TESTS)
    assert run_pytest(tmp_path, strict=False) == ("4 skipped, 1 xfailed", 0)
    assert run_pytest(tmp_path, strict=True) == ("3 failed, 1 skipped, 1 xfailed", 1)


@pytest.mark.slow
def test_a_module_fails_if_what_it_misses_can_be_installed(tmp_path):
    (tmp_path / "test_other.py").write_text(MODULE)
    assert run_pytest(tmp_path, strict=False) == ("1 skipped", 5)
    assert run_pytest(tmp_path, strict=True) == ("1 error", 2)
