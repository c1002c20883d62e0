"""Windows and macOS: the lint that looks for what they lack, the console's keys, the demo."""

from __future__ import annotations

import importlib.util
import itertools
import os
import queue
import subprocess
import sys
from pathlib import Path

import pytest

from turtlewire import demo
from turtlewire.console_keyboard import Keyboard

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def platforms():
    spec = importlib.util.spec_from_file_location("platforms", ROOT / "scripts" / "platforms.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_nothing_is_used_that_only_posix_has(platforms, capsys):
    assert platforms.main() == 0, capsys.readouterr().out


@pytest.mark.parametrize(
    ("source", "line"),
    [
        ("import fcntl\n", 1),
        ("import os\nfrom termios import tcgetattr\n", 2),
        ("def f():\n    return open('/proc/self/status')\n", 2),
        ("import subprocess\n\nsubprocess.run(['bash', '-c', 'true'])\n", 3),
    ],
)
def test_the_lint_finds_what_is_not_guarded(platforms, monkeypatch, tmp_path, source, line):
    monkeypatch.setattr(platforms, "ROOT", tmp_path)
    (tmp_path / "module.py").write_text(source)
    [(found, _)] = platforms.faults(tmp_path / "module.py")
    assert found == line


@pytest.mark.parametrize(
    "source",
    [
        "import sys\n\nassert sys.platform != 'win32'\nimport termios\n",
        "def f():\n    import termios\n",
        "import sys\nPATH = '/dev/tty' if sys.platform != 'win32' else 'CON'\n",
        "def f():\n    if sys.platform == 'win32':\n        return\n    open('/dev/tty')\n",
        '"""bash"""\n',
    ],
)
def test_the_lint_lets_pass_what_is_guarded(platforms, monkeypatch, tmp_path, source):
    monkeypatch.setattr(platforms, "ROOT", tmp_path)
    (tmp_path / "module.py").write_text(source)
    assert list(platforms.faults(tmp_path / "module.py")) == []


def typed(*characters: str) -> Keyboard:
    """A console on which these were typed; then nobody types any more."""
    keys: queue.SimpleQueue[str] = queue.SimpleQueue()
    for character in characters:
        keys.put(character)
    return Keyboard(read_character=keys.get)


def test_the_console_gives_the_bytes_of_a_terminal():
    with typed(
        "q", "\xe0", "H", "\x00", "P", "\xe0", "M", "\xe0", "K", "é", "\xe0", "G", "x"
    ) as keys:
        expected = b"q\x1b[A\x1b[B\x1b[C\x1b[D" + "é".encode() + b"x"
        assert b"".join(keys.read() for _ in expected) == expected


def test_ctrl_c_in_the_console_ends_the_reads():
    with typed("a", "\x03") as keys:
        assert list(itertools.takewhile(bool, iter(keys.read, None))) in ([b"a"], [])
        assert keys.read() == b""


def test_stopping_ends_a_read_of_the_console():
    with typed() as keys:
        keys.stop()
        assert keys.read() == b""


def test_the_demo_says_which_package_lacks(monkeypatch, capsys):
    monkeypatch.setattr(demo, "find_spec", lambda name: None if name == "turtlesim" else name)
    assert demo.main([]) == 1
    said = capsys.readouterr().err
    assert "not installed: turtlesim\n" in said
    assert said.endswith("-m pip install ./ros\n")


@pytest.mark.slow
def test_the_demo_runs_without_bash(tmp_path):
    variables = {"TURTLEWIRE_BROWSER": "0", "TURTLEWIRE_PORT": "0", "ROS_LOG_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-m", "turtlewire.demo", "--seconds", "20"],
        env={**os.environ, **variables},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "Successfully spawned turtle2" in said
    assert said.count("process has finished cleanly") == 4
