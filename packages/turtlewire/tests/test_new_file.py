import os
import signal
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.disks import full_disk

from turtlewire import Buffer
from turtlewire.new_file import new_file
from turtlewire.trajectory import Trajectory


def write(path, text):
    with new_file(path) as unfinished, open(unfinished, "w") as file:
        file.write(text)


def saved_buffer(path):
    buffer = Buffer()
    buffer.set_transform("world", "turtle", 0, (1, 2, 3))
    buffer.save(path)


def walk():
    return Trajectory(np.arange(99) * 10**9, np.tile((0, 0, 0, 0, 0, 0, 1.0), (99, 1)))


@pytest.mark.parametrize(
    ("name", "save"),
    [
        ("buffer.npz", saved_buffer),
        ("path.tum", lambda path: walk().save(path)),
        ("path.svg", lambda path: walk().plot().save(path)),
    ],
)
def test_a_full_disk_leaves_the_older_file(tmp_path, name, save):
    path = tmp_path / name
    path.write_text("older")
    with full_disk(), pytest.raises(OSError, match=name) as caught:
        save(path)
    assert caught.value.filename == str(path)
    assert path.read_text() == "older"
    assert os.listdir(tmp_path) == [name]
    save(path)
    assert path.read_bytes() != b"older"


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_a_killed_program_leaves_the_older_file(tmp_path):
    path = tmp_path / "file"
    path.write_text("older")
    program = (
        "import os, signal, sys\n"
        "from turtlewire.new_file import new_file\n"
        "with new_file(sys.argv[1]) as path, open(path, 'w') as file:\n"
        "    file.write('half')\n"
        "    file.flush()\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", program, path], timeout=60, check=False)
    assert done.returncode == -signal.SIGKILL
    assert path.read_text() == "older"
    write(path, "newer")
    assert path.read_text() == "newer"
    assert os.listdir(tmp_path) == ["file"]


def test_a_link_and_permissions_stay(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("older")
    target.chmod(0o600)
    link.symlink_to(target)
    write(link, "newer")
    assert link.is_symlink()
    assert target.read_text() == "newer"
    assert stat.S_IMODE(target.stat().st_mode) == 0o600


def test_a_link_to_a_missing_file_makes_it(tmp_path):
    (tmp_path / "link").symlink_to("target")
    write(tmp_path / "link", "text")
    assert (tmp_path / "target").read_text() == "text"


@pytest.mark.skipif(not hasattr(os, "geteuid") or not os.geteuid(), reason="root may write")
def test_a_read_only_file_is_not_replaced(tmp_path):
    path = tmp_path / "file"
    path.write_text("older")
    path.chmod(0o400)
    with pytest.raises(PermissionError, match=f"'{path}'"):
        write(path, "newer")
    assert path.read_text() == "older"


@pytest.mark.skipif(sys.platform != "linux", reason="needs /dev/full")
def test_a_device_is_written_and_stays(tmp_path):
    path = tmp_path / "file"
    path.symlink_to("/dev/full")
    with pytest.raises(OSError, match=f"No space left on device: '{path}'"):
        write(path, "text")
    assert Path("/dev/full").is_char_device()


@pytest.mark.parametrize("where", ["missing/file", "folder"])
def test_a_path_that_cannot_be_written_is_named(tmp_path, where):
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError, match="directory") as caught:
        write(tmp_path / where, "text")
    assert caught.value.filename == str(tmp_path / where)


def test_an_error_of_another_file_keeps_its_name(tmp_path):
    with pytest.raises(FileNotFoundError) as caught, new_file(tmp_path / "file"):
        (tmp_path / "input").read_bytes()
    assert caught.value.filename == str(tmp_path / "input")
    assert os.listdir(tmp_path) == []
