"""Hosts and origins that are allowed, on this computer and behind a proxy."""

import pytest

from turtlewire.web.origin import proxied_refusal, refusal


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


@pytest.mark.parametrize(
    ("host", "forwarded", "origin"),
    [
        ("hub.example", [], None),
        ("hub.example:8443", [], "https://hub.example:8443"),
        ("Hub.example", [], "http://hub.example"),
        ("[2001:db8::7]:443", [], "https://[2001:db8::7]:443"),
        ("127.0.0.1:7070", ["hub.example"], "https://hub.example"),
        ("127.0.0.1:7070", ["hub.example, inner.example"], "https://hub.example"),
        ("127.0.0.1:7070", ["hub.example", "inner.example"], "https://inner.example"),
        ("hub.example", [""], "https://hub.example"),
    ],
)
def test_a_proxy_may_use_any_name_and_its_own_pages(host, forwarded, origin):
    assert proxied_refusal([host], forwarded, [origin] if origin else []) is None


@pytest.mark.parametrize(
    "hosts",
    [
        [],
        [""],
        ["hub.example", "hub.example"],
        ["hub.example; script-src *"],
        ["hub.example:x"],
        ["hub example"],
        ["[::1"],
    ],
)
def test_a_host_behind_a_proxy_is_one_name(hosts):
    assert "expected one name" in proxied_refusal(hosts, [], [])


@pytest.mark.parametrize(
    ("forwarded", "origins"),
    [
        ([], ["https://evil.example"]),
        ([], ["https://hub.example:8443"]),
        ([], ["https://hub.example.evil.example"]),
        ([], ["ftp://hub.example"]),
        ([], ["null"]),
        ([], [""]),
        ([], ["https://hub.example", "https://hub.example"]),
        (["inner.example"], ["https://evil.example"]),
        ([""], ["https://"]),
    ],
)
def test_pages_of_other_names_are_refused_behind_a_proxy(forwarded, origins):
    assert "Origin is" in proxied_refusal(["hub.example"], forwarded, origins)
