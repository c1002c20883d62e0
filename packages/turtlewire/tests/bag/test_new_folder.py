"""Remains of a new folder from killed processes are removed; folders of living ones are not."""

import subprocess
import sys
import threading
from contextlib import suppress

import pytest

from turtlewire.bag.pieces import new_folder

pytest.importorskip("fcntl")

WRITER = """
import os, sys
from turtlewire.bag.pieces import new_folder
with new_folder(sys.argv[1]) as path:
    os.mkdir(path)
    print("ready", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def writer(tmp_path):
    """A process that has begun to write the folder ``out``."""
    command = [sys.executable, "-c", WRITER, str(tmp_path / "out")]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    yield process
    process.kill()
    process.communicate()


def write(path):
    with new_folder(path) as scratch:
        (path.parent / scratch).mkdir()


def parts(tmp_path):
    return sorted(each.name for each in tmp_path.iterdir() if each.name.endswith(".part"))


def test_the_next_run_removes_what_a_killed_process_has_left(tmp_path, writer):
    writer.kill()
    writer.communicate()
    assert len(parts(tmp_path)) == 1
    (tmp_path / ".out.mine.part").mkdir()  # not one of ours
    (tmp_path / ".other.1-2.part").mkdir()  # of another folder
    write(tmp_path / "out")
    assert (tmp_path / "out").is_dir()
    assert parts(tmp_path) == [".other.1-2.part", ".out.mine.part"]


def test_the_folder_of_a_living_process_is_left_alone(tmp_path, writer):
    (left,) = parts(tmp_path)
    write(tmp_path / "out")
    assert parts(tmp_path) == [left]
    assert (tmp_path / left / "out").is_dir()
    writer.communicate("")
    assert writer.returncode == 1  # `out` exists by now
    assert parts(tmp_path) == []


def test_threads_do_not_remove_each_others_folders(tmp_path):
    begun, done = threading.Event(), threading.Event()

    def first():
        with new_folder(tmp_path / "out") as scratch:
            (tmp_path / scratch).mkdir()
            begun.set()
            assert done.wait(60)

    thread = threading.Thread(target=first)
    thread.start()
    try:
        assert begun.wait(60)
        with suppress(RuntimeError), new_folder(tmp_path / "out"):
            assert len(parts(tmp_path)) == 2
            raise RuntimeError("stop")
        assert len(parts(tmp_path)) == 1
    finally:
        done.set()
        thread.join()
    assert (tmp_path / "out").is_dir()


def test_a_link_is_not_followed(tmp_path):
    (tmp_path / "precious").mkdir()
    (tmp_path / ".out.1-2.part").symlink_to(tmp_path / "precious")
    write(tmp_path / "out")
    assert (tmp_path / "precious").is_dir()
