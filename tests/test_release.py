"""`scripts/release`: what does not take minutes; the rest is tried by releasing."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture
def release():
    spec = importlib.util.spec_from_file_location("release", ROOT / "scripts" / "release.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def sources(release, monkeypatch, tmp_path):
    """Two projects and a CHANGELOG in an empty folder."""
    monkeypatch.setattr(release, "ROOT", tmp_path)
    monkeypatch.setattr(release, "PROJECTS", {"one": tmp_path, "two": tmp_path / "ros"})
    (tmp_path / "ros").mkdir()
    for folder in (tmp_path, tmp_path / "ros"):
        (folder / "pyproject.toml").write_text('[project]\nversion = "1.2.0"\n')
    (tmp_path / "CHANGELOG.md").write_text(
        "# Changelog\n\n## Unreleased\n\n- New.\n\n## 1.1.0\n\n- Old.\n"
    )
    return tmp_path


def test_the_version_of_the_sources_is_one(release):
    assert re.fullmatch(r"\d+\.\d+\.\d+", release.version_of_all())


def test_different_versions_are_no_release(release, sources):
    assert release.version_of_all() == "1.2.0"
    other = 'version = "1.2.0"\ndependencies = [\n    "turtlewire==1.1.0",\n]\n'
    (sources / "ros" / "pyproject.toml").write_text(other)
    with pytest.raises(release.ReleaseError, match=r"different versions: 1\.1\.0, 1\.2\.0"):
        release.version_of_all()


def test_the_notes_are_the_section_of_the_version_or_what_is_unreleased(release, sources):
    assert release.notes("1.1.0") == "# turtlewire 1.1.0\n\n- Old.\n"
    assert release.notes("1.2.0") == "# turtlewire 1.2.0\n\n- New.\n"
    (sources / "CHANGELOG.md").write_text("# Changelog\n\n## 1.1.0\n\n- Old.\n")
    with pytest.raises(release.ReleaseError, match=r"no section .1\.2\.0."):
        release.notes("1.2.0")


def test_a_step_that_fails_shows_what_it_printed(release, capsys):
    with pytest.raises(release.ReleaseError, match="the step failed, see above"):
        release.run("python3", "-c", "print('why'); raise SystemExit(3)", what="the step")
    assert "why" in capsys.readouterr().err


def test_an_unknown_python_is_refused(release, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["release", "--python", "3.9"])
    with pytest.raises(SystemExit) as ended:
        release.main()
    assert ended.value.code == 2
    assert "3.9" in capsys.readouterr().err
