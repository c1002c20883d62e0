"""Answers of `scripts/docs --serve` and `scripts/lesson --serve`, and allowed clients."""

from __future__ import annotations

import base64
import hashlib
import http.client

import pytest
from tests.static_host import Host

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
