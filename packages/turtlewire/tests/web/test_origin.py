"""Which Host and Origin headers are welcome."""

from __future__ import annotations

import pytest

from turtlewire.web.origin import refusal


@pytest.mark.parametrize(
    ("host", "origin"),
    [
        ("127.0.0.1:7070", None),
        ("localhost:7070", "http://localhost:7070"),
        ("LOCALHOST:1", "http://localhost:1"),
        ("[::1]:7070", "http://[::1]:7070"),
        ("localhost", "http://localhost"),
    ],
)
def test_own_pages_are_welcome(host, origin):
    assert refusal([host], [origin] if origin else []) is None


@pytest.mark.parametrize(
    "hosts",
    [
        [],
        ["evil.example"],
        ["evil.example:7070"],
        ["127.0.0.1.evil.example"],
        ["localhost:x"],
        ["127.0.0.1:80:80"],
        ["evil.example", "localhost"],
        ["localhost", "evil.example"],
        ["localhost", "localhost"],
        [""],
    ],
)
def test_foreign_hosts_are_refused(hosts):
    assert "Host is" in refusal(hosts, [])


@pytest.mark.parametrize(
    "origins",
    [
        ["http://evil.example"],
        ["http://localhost:9999"],
        ["https://localhost:7070"],
        ["null"],
        ["http://localhost:7070", "http://localhost:7070"],
        [""],
    ],
)
def test_foreign_origins_are_refused(origins):
    assert "Origin is" in refusal(["localhost:7070"], origins)
