"""Windows and macOS: the lint for missing functions, the console's keys, the demo."""

from __future__ import annotations

import itertools
import os
import queue
import runpy
import signal
import subprocess
import sys

import platforms
import pytest
from tests.places import ENGINE, ROOT, TOOLS

from turtlewire import demo
from turtlewire.terminal.console_keyboard import ConsoleKeyboard
from turtlewire.wire.wheels import Platform, advice


@pytest.mark.slow
def test_nothing_is_used_that_only_posix_has(capsys):
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
def test_the_lint_finds_what_is_not_guarded(monkeypatch, tmp_path, source, line):
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
def test_the_lint_lets_pass_what_is_guarded(monkeypatch, tmp_path, source):
    monkeypatch.setattr(platforms, "ROOT", tmp_path)
    (tmp_path / "module.py").write_text(source)
    assert list(platforms.faults(tmp_path / "module.py")) == []


def typed(*characters: str) -> ConsoleKeyboard:
    """A console on which these were typed; then nobody types any more."""
    keys: queue.SimpleQueue[str] = queue.SimpleQueue()
    for character in characters:
        keys.put(character)
    return ConsoleKeyboard(read_character=keys.get)


def test_a_wait_for_a_key_of_the_console_has_a_limit():
    with typed("k") as keys:
        assert keys.read_within(60) == b"k"
        assert keys.read_within(0) is None
        keys.stop()
        assert keys.read_within(60) == b""


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
    assert said.endswith("-m pip install ./packages/turtlewire-ros\n")


@pytest.mark.skipif(sys.platform == "win32", reason="quotes of a Unix shell")
def test_the_demo_quotes_a_path_with_a_space(monkeypatch, capsys):
    monkeypatch.setattr(demo, "_ros2", lambda: "/my env/bin/ros2")
    monkeypatch.setattr(demo, "_run", lambda command, seconds: 0)
    assert demo.main([]) == 0
    assert "    '/my env/bin/ros2' run turtlesim turtle_teleop_key\n" in capsys.readouterr().out


@pytest.mark.skipif(sys.platform == "win32", reason="quotes of a Unix shell")
def test_the_bundle_quotes_a_path_with_a_space(monkeypatch, capsys, tmp_path):
    start = runpy.run_path(str(TOOLS / "bundle_files" / "start.py"))["main"]
    monkeypatch.setitem(start.__globals__, "WHEELS", tmp_path)  # nothing to install
    folder = tmp_path / "my class"
    folder.mkdir()
    (folder / "installed").touch()
    monkeypatch.setattr(sys, "argv", ["start.py", "--install-only", "--into", str(folder)])
    assert start() == 0
    (first, _) = capsys.readouterr().out.splitlines()
    assert first == f"In other terminals, type first:  . '{folder}/bin/activate'"


DEMO_VARIABLES = {"TURTLEWIRE_BROWSER": "0", "TURTLEWIRE_PORT": "0"}


@pytest.mark.slow
@pytest.mark.parametrize("options", [(), ("--seconds", "1000")])
@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_to_the_demo_alone_ends_all_its_processes(run, options, signum):
    demo = run(sys.executable, "-m", "turtlewire.demo", *options, environment=DEMO_VARIABLES)
    demo.wait_for("Successfully spawned turtle2")
    demo.process.send_signal(signum)
    demo.wait()
    demo.wait_for_survivors()
    assert "Traceback" not in demo.text


@pytest.mark.slow
def test_the_demo_runs_without_bash(tmp_path):
    variables = {**DEMO_VARIABLES, "ROS_LOG_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-m", "turtlewire.demo", "--seconds", "20"],
        env={**os.environ, **variables},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "Successfully spawned turtle2" in said
    assert said.count("process has finished cleanly") == 4


# The table of docs/install.md

#: Beginnings of the wheels that PyPI has, and their platforms (2026-11).
WHEELS = {
    "cyclonedds": (
        ["cp310", "cp311", "cp312", "cp313"],
        ["linux x86_64", "darwin x86_64", "darwin arm64", "win32 AMD64"],
    ),
    "eclipse-zenoh": (
        ["abi3"],
        [
            *("linux x86_64", "linux aarch64", "linux armv7l", "linux i686"),
            *("darwin x86_64", "darwin arm64", "win32 AMD64"),
        ],
    ),
    "numpy": (
        ["cp310", "cp311", "cp312", "cp313", "cp314", "pypy"],
        [
            *("linux x86_64", "linux aarch64", "darwin x86_64", "darwin arm64"),
            *("win32 AMD64", "win32 ARM64"),
        ],
    ),
}
MACHINES = {
    "Linux x86-64": [("linux", "x86_64")],
    "Linux arm64 (Raspberry Pi, Jetson)": [("linux", "aarch64")],
    "Linux armv7, i686 (32 bit)": [("linux", "armv7l"), ("linux", "i686")],
    "Linux armv6 (Raspberry Pi Zero)": [("linux", "armv6l")],
    "macOS, Apple silicon and Intel": [("darwin", "arm64"), ("darwin", "x86_64")],
    "Windows x64": [("win32", "AMD64")],
    "Windows arm64": [("win32", "ARM64")],
    "PyPy": [("linux", "x86_64"), ("darwin", "arm64"), ("win32", "AMD64")],
}
VERSIONS = {"Python 3.10\N{EN DASH}3.13": ["3.10", "3.11", "3.12", "3.13"], "Python 3.14": ["3.14"]}


def table() -> list[tuple[str, str, str, str, str]]:
    """The cells: what they say, system, machine, version and interpreter."""
    text = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
    head, _, *rows = (
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in text[text.index("| system | Python") :].split("\n\n")[0].splitlines()
    )
    return [
        (cell, system, machine, version, "pypy" if row[0] == "PyPy" else "cpython")
        for row in rows
        for column, cell in zip(head[1:], row[1:], strict=True)
        for system, machine in MACHINES[row[0]]
        for version in VERSIONS[column]
    ]


def installed(system: str, machine: str, version: str, interpreter: str) -> set[str]:
    """Return the packages that pip installs there, by the markers of pyproject.toml."""
    requirements = pytest.importorskip("packaging.requirements")
    tomllib = pytest.importorskip("tomllib")  # Python 3.11
    project = tomllib.loads((ENGINE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    there = {
        "sys_platform": system,
        "platform_machine": machine,
        "python_version": version,
        "implementation_name": interpreter,
    }
    wanted = map(requirements.Requirement, project["dependencies"])
    return {one.name for one in wanted if one.marker is None or one.marker.evaluate(there)}


@pytest.mark.parametrize(("cell", "system", "machine", "version", "interpreter"), table())
def test_the_table_says_what_pip_installs(cell, system, machine, version, interpreter):
    names = installed(system, machine, version, interpreter)
    network = "DDS" if "cyclonedds" in names else "Zenoh" if "eclipse-zenoh" in names else ""
    without = "" if "numpy" in names else ", without NumPy"
    assert cell == (network or "buffer only") + without
    assert ("xxhash" in names) == (network == "Zenoh")
    pythons = {"pypy"} if interpreter == "pypy" else {f"cp{version.replace('.', '')}", "abi3"}
    for name in names & set(WHEELS):
        tags, places = WHEELS[name]
        assert pythons & set(tags), name
        assert f"{system} {machine}" in places, name


@pytest.mark.parametrize(("cell", "system", "machine", "version", "interpreter"), table())
def test_the_advice_fits_the_table(cell, system, machine, version, interpreter):
    major, minor = map(int, version.split("."))
    here = Platform(system, machine, (major, minor), interpreter == "cpython")
    assert here.has_cyclone == (cell == "DDS")
    assert here.has_zenoh == (not cell.startswith("buffer only"))
    said = advice(here)
    assert ("pip install cyclonedds" in said) == here.has_cyclone
    assert ("turtlewire[zenoh]" in said) == here.has_zenoh


def test_nothing_is_advised_that_has_no_wheel():
    musl = Platform("linux", "x86_64", (3, 12), False)
    assert not musl.has_cyclone
    assert not musl.has_zenoh
    assert advice(musl).startswith("Install libddsc 0.10")
    arm = Platform("win32", "ARM64", (3, 12), True)
    assert advice(arm).startswith("There is no wheel of Cyclone DDS or Zenoh for it")
