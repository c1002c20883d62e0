"""Answers of `scripts/docs --serve` and `scripts/lesson --serve`, and allowed clients.

`scripts/docs --releases`: each tag is built by its own script, below its number.
"""

import base64
import hashlib
import http.client
import json
import subprocess
from pathlib import Path

import pytest
from docs_releases import add_releases, is_of_release, releases
from lesson import BuildError
from tests.plain_server import Host

INLINE = "document.title = 'a'"


@pytest.fixture
def pages(tmp_path):
    """A folder with a page, a folder without one, and links that lead out of it and within it."""
    (tmp_path / "secret.txt").write_text("secret")
    (tmp_path / "secrets").mkdir()
    (tmp_path / "secrets" / "a.txt").write_text("secret")
    folder = tmp_path / "pages"
    (folder / "sub").mkdir(parents=True)
    (folder / "index.html").write_text(
        f"<script src='a.js'></script><script>{INLINE}</script><script src='b.js'></script>"
    )
    (folder / "sub" / "a.js").write_text("1")
    (folder / "link.txt").symlink_to(tmp_path / "secret.txt")
    (folder / "links").symlink_to(tmp_path / "secrets")
    (folder / "sub" / "index.html").symlink_to(tmp_path / "secret.txt")
    (folder / "within.js").symlink_to(folder / "sub" / "a.js")
    host = Host(folder)
    yield host
    host.close()


def ask(pages, path, **headers):
    connection = http.client.HTTPConnection(pages.url.split("/")[2], timeout=60)
    try:
        connection.putrequest("GET", path, skip_host="Host" in headers)
        for name, value in headers.items():
            for each in [value] if isinstance(value, str) else value:
                connection.putheader(name, each)
        connection.endheaders()
        answer = connection.getresponse()
        return answer, answer.read()
    finally:
        connection.close()


def test_pages_are_served(pages):
    for path in ("/", "/index.html", "/index.html?q=1"):
        answer, body = ask(pages, path)
        assert answer.status == 200
        assert INLINE.encode() in body
    for path in ("/sub/a.js", "/within.js"):
        assert ask(pages, path)[1] == b"1"


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "evil.example"},
        {"Host": "127.0.0.1.evil.example:8000"},
        {"Host": ["localhost", "evil.example"]},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
    ],
)
def test_foreign_names_and_pages_are_refused(pages, headers):
    answer, body = ask(pages, "/", **headers)
    assert answer.status == 403
    assert b"this server answers only to" in body
    assert INLINE.encode() not in body


@pytest.mark.parametrize(
    "path",
    ["/link.txt", "/links/a.txt", "/links/", "/sub/", "/../secret.txt", "/%2e%2e/secret.txt"],
)
def test_nothing_outside_the_folder_is_served(pages, path):
    answer, body = ask(pages, path)
    assert answer.status == 404
    assert b"secret" not in body


def test_folders_are_not_listed(pages):
    (answer, body) = ask(pages, "/links")
    assert answer.status == 404
    assert b"a.txt" not in body


def test_the_policy_allows_what_stands_in_the_page_and_comes_from_here(pages):
    answer, _ = ask(pages, "/")
    policy = answer.headers["Content-Security-Policy"]
    digest = base64.b64encode(hashlib.sha256(INLINE.encode()).digest()).decode()
    assert f"script-src 'self' 'wasm-unsafe-eval' 'sha256-{digest}';" in policy
    assert "default-src 'self'" in policy
    assert "frame-ancestors 'none'" in policy
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert "sha256" not in ask(pages, "/sub/a.js")[0].headers["Content-Security-Policy"]
    assert "Content-Security-Policy" in ask(pages, "/none")[0].headers


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
