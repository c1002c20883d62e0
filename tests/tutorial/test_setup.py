"""What scripts/setup installs, and what it leaves as it is."""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path

import pytest

SETUP = Path(__file__).parents[2] / "scripts" / "setup.py"


@pytest.fixture
def setup(monkeypatch, tmp_path):
    """The module, with a pip that only notes what it is to do."""
    spec = importlib.util.spec_from_file_location("setup_script", SETUP)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
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
    assert words.count("-e") == 3
    assert str(setup.ROOT) in words
    setup.main(["workspace"])
    setup.main([])
    assert len(setup.calls) == 1


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
    assert setup.calls[1].count("-e") == 3


def test_what_fails_is_named(setup, capfd):
    with pytest.raises(setup.SetupError, match="this failed, see above"):
        setup.checked([sys.executable, "-c", "import sys; print('why'); sys.exit(3)"])
    assert capfd.readouterr().err == "why\n"


def test_a_terminal_shows_that_it_goes_on(run):
    code = f"import runpy, sys; checked = runpy.run_path({str(SETUP)!r})['checked']; "
    code += "checked([sys.executable, '-c', 'import time; time.sleep(1.5)']); print('ready')"
    program = run(sys.executable, "-c", code, terminal=True)
    program.wait_for("ready")
    assert "[setup] 1 s" in program.text
