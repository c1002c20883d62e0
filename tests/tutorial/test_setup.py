"""What scripts/setup installs, what it leaves as it is, and what it prints."""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / "scripts"
SETUP = SCRIPTS / "setup.py"


@pytest.fixture
def setup(monkeypatch, tmp_path):
    """The module, with a pip that only notes what it is to do."""
    spec = importlib.util.spec_from_file_location("setup_script", SETUP)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.delenv("CI", raising=False)
    module.calls = []
    monkeypatch.setattr(module, "pip", lambda *words: module.calls.append(words))
    monkeypatch.setattr(module, "ensure_pip", lambda: None)
    monkeypatch.setattr(module, "make_venv", lambda: module.calls.append("make_venv"))
    monkeypatch.setattr(module, "usable", lambda _stamp, _wanted: True)
    monkeypatch.setattr(module, "STAMP", tmp_path / "stamp.json")
    return module


def test_nothing_is_done_twice(setup):
    setup.main(["workspace"])
    ((_install, *words),) = setup.calls
    assert words.count("-e") == 4
    assert str(setup.ROOT) in words
    setup.main(["workspace"])
    setup.main([])
    assert len(setup.calls) == 1


def test_ci_installs_what_is_locked_first(setup, monkeypatch):
    monkeypatch.setenv("CI", "true")
    setup.main(["test"])
    locked, (_install, *words) = setup.calls
    assert locked == ("install", "--require-hashes", "-r", str(SCRIPTS / "locks" / "ci.txt"))
    assert words.count("-e") == 4


def test_extras_alone_compile_nothing(setup):
    setup.main([])
    setup.main(["workspace"])
    assert setup.calls[1] == ("install", "turtlewire-ros[workspace]")
    setup.main(["lint"])
    assert setup.calls[2] == (
        "install",
        "turtlewire-ros[workspace]",
        "--group",
        f"{setup.ROOT / 'pyproject.toml'}:lint",
    )
    assert json.loads(setup.STAMP.read_text())["extras"] == ["lint", "workspace"]


def test_changed_sources_are_installed_with_the_extras_there_are(setup, monkeypatch):
    setup.main(["workspace"])
    monkeypatch.setattr(setup, "fingerprint", lambda: "other")
    setup.main([])
    assert f"{setup.ROOT / 'ros'}[workspace]" in setup.calls[1]
    assert setup.calls[1].count("-e") == 4


def test_each_native_source_counts(setup, monkeypatch, tmp_path):
    """All that CMake compiles; not the core's own tests, which are built elsewhere."""
    sources = sorted((setup.ROOT / "native").rglob("*.?pp"))
    folders = {path.parent.name for path in sources}
    assert folders >= {"bindings", "core", "cyclone", "tests"}
    root = setup.ROOT
    for name, path in vars(setup).copy().items():
        if isinstance(path, Path) and path.is_relative_to(root):
            monkeypatch.setattr(setup, name, tmp_path / path.relative_to(root))
    (tmp_path / "native").mkdir()
    for name in ("pyproject.toml", "native/CMakeLists.txt"):
        (tmp_path / name).touch()
    for folder in folders:
        (tmp_path / "native" / folder).mkdir()
        before = setup.fingerprint()
        (tmp_path / "native" / folder / "new.cpp").write_text("int changed;")
        assert (setup.fingerprint() == before) == (folder == "tests"), folder


def test_what_fails_is_named(setup, capfd):
    with pytest.raises(setup.SetupError, match="this failed, see above"):
        setup.checked([sys.executable, "-c", "import sys; print('why'); sys.exit(3)"])
    assert capfd.readouterr().err == "why\n"


def printing(text: str, status: int) -> list[str]:
    """A command that stands for pip."""
    return [
        sys.executable,
        "-c",
        f"import sys; print({text!r}, file=sys.stderr); sys.exit({status})",
    ]


def test_a_missing_network_is_one_line(setup, monkeypatch, capfd):
    text = (
        "WARNING: Retrying (…) after connection broken by 'NewConnectionError(…)'\nERROR: No match"
    )
    monkeypatch.setattr(setup, "pip", lambda *_words: setup.checked(printing(text, 1)))
    assert setup.run([]) == 1
    *_, said = capfd.readouterr().err.splitlines()
    assert said.startswith("[setup] no network: ")
    assert "Retrying" not in said
    monkeypatch.setattr(setup, "pip", lambda *_words: None)
    assert setup.run([]) == 0  # the folder is not locked any more


def test_warnings_of_a_pip_that_succeeds_are_not_shown(setup, capfd):
    setup.checked(printing("WARNING: Location '/wheels' is ignored", 0))
    assert capfd.readouterr().err == ""


def test_an_unknown_extra_is_refused_with_those_there_are(setup, capfd):
    with pytest.raises(SystemExit) as ended:
        setup.run(["tset"])
    assert ended.value.code == 2
    assert "there is no extra 'tset'; choose from test, lint, workspace" in capfd.readouterr().err
    assert setup.calls == []


#: scripts/setup with a pip that tells when it runs, and complains at length when it is interrupted.
SLOW_PIP = f"""
import importlib.util, sys
spec = importlib.util.spec_from_file_location("setup_script", {str(SETUP)!r})
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
pip = "import os, sys, time; os.write(int(sys.argv[1]), b'pip runs'); time.sleep(600)"
import os, subprocess
told, tell = os.pipe()
start = subprocess.Popen
subprocess.Popen = lambda command, **options: start(
    [*command, str(tell)], pass_fds=[tell], **options)
module.show_progress = lambda text: text and print(os.read(told, 100).decode(), flush=True)
module.main = lambda extras: module.checked([sys.executable, "-c", pip])
sys.exit(module.run([]))
"""


def test_ctrl_c_while_pip_runs_is_one_line(run):
    program = run(SCRIPTS / "interruptible", sys.executable, "-c", SLOW_PIP, terminal=True)
    program.wait_for("pip runs")
    program.type("\x03")
    assert program.wait() == 130
    assert "[setup] interrupted; the next run goes on" in program.text
    assert "Traceback" not in program.text
    assert program.survivors() == []


def test_ctrl_c_while_python_starts_is_silent(run, tmp_path):
    (tmp_path / "sitecustomize.py").write_text("print('starting', flush=True)\nwhile True: pass\n")
    command = ["env", f"PYTHONPATH={tmp_path}", sys.executable, "-c", ""]
    program = run(SCRIPTS / "interruptible", *command, terminal=True)
    program.wait_for("starting")
    program.type("\x03")
    assert program.wait() == 130
    assert program.text.replace("^C", "").split() == ["starting"]
    assert program.survivors() == []


@pytest.mark.parametrize("status", [0, 3])
def test_an_interruptible_program_keeps_its_status_and_its_input(run, status):
    code = f"import sys; print(input()); sys.exit({status})"
    program = run(SCRIPTS / "interruptible", sys.executable, "-c", code, terminal=True)
    program.type("hello\r")
    assert program.wait() == status
    assert program.text.split()[-1] == "hello"


def test_a_terminal_shows_that_it_goes_on(run):
    code = f"import runpy, sys; checked = runpy.run_path({str(SETUP)!r})['checked']; "
    code += "checked([sys.executable, '-c', 'import time; time.sleep(1.5)']); print('ready')"
    program = run(sys.executable, "-c", code, terminal=True)
    program.wait_for("ready")
    assert "[setup] 1 s" in program.text
