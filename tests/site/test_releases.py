"""`scripts/docs --releases`: each tag is built by its own script, below its number."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from docs_releases import add_releases, is_of_release, releases
from lesson_npm import BuildError

#: Stands for `scripts/docs` of a release: it writes down how it was called.
SCRIPT = """#!/bin/sh
mkdir -p "$2" && echo "{version} $3 $4" > "$2/index.html"
{end}
"""


@pytest.fixture
def repository(tmp_path):
    folder = tmp_path / "repository"
    (folder / "scripts").mkdir(parents=True)
    _git(folder, "init", "-q")
    return folder


def _git(folder, *words):
    who = ("-c", "user.name=A", "-c", "user.email=a@example.org")
    subprocess.run(["git", "-C", folder, *who, *words], check=True, capture_output=True)


def _release(folder, version, end=""):
    script = folder / "scripts" / "docs"
    script.write_text(SCRIPT.format(version=version, end=end))
    script.chmod(0o755)
    _git(folder, "add", ".")
    _git(folder, "commit", "-qm", version)
    _git(folder, "tag", version)


def test_each_release_is_built_by_its_own_script(repository, tmp_path, capfd):
    for tag in ("v0.9.0", "v0.10.0", "v1.0.0rc1", "other"):
        _release(repository, tag)
    site = tmp_path / "site"
    site.mkdir()
    assert add_releases(repository, site, "/project/") == ["0.10.0", "0.9.0"]
    assert json.loads((site / "versions.json").read_text()) == ["0.10.0", "0.9.0"]
    text = (site / "0.9.0" / "index.html").read_text()
    assert text == "v0.9.0 --base /project/0.9.0/\n"
    assert "building 0.10.0" in capfd.readouterr().out


def test_the_folder_of_the_site_may_be_relative(repository, tmp_path, monkeypatch):
    _release(repository, "v0.1.0")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "site").mkdir()
    add_releases(repository, Path("site"), "/")
    assert (tmp_path / "site" / "0.1.0" / "index.html").exists()


def test_a_release_that_cannot_be_built_leaves_no_work_tree(repository, tmp_path):
    _release(repository, "v0.1.0", end="exit 3")
    with pytest.raises(BuildError, match=r"the site of 0\.1\.0 was not built"):
        add_releases(repository, tmp_path, "/")
    listed = subprocess.run(
        ["git", "-C", repository, "worktree", "list"], capture_output=True, text=True, check=True
    )
    assert len(listed.stdout.splitlines()) == 1


def test_no_releases(repository):
    assert releases(repository) == []


@pytest.mark.parametrize(
    ("base", "expected"),
    [("/x/0.1.0/", True), ("/x/0.1.0", True), ("/", False), ("/x/10.1.0/", False), ("/x/", False)],
)
def test_the_folder_of_a_release_is_known_by_its_base(base, expected):
    assert is_of_release(base, "0.1.0") is expected
