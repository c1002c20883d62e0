"""A page for other devices: nothing without the token, the address that others reach, its code."""

from __future__ import annotations

import http.client
import io
import os
import re
import shutil
import socket
import sys
from types import SimpleNamespace

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from turtlewire.web import Server, WebContent, lan
from turtlewire.web.origin import refusal


class Silent:
    """A session that sends one word."""

    def outgoing(self):
        return ["hello"]

    def receive(self, message):
        pass

    def closed(self):
        pass


@pytest.fixture
def serve(tmp_path):
    (tmp_path / "index.html").write_text("<p>hello</p>")
    (tmp_path / "part.js").write_text("export {};")
    servers = []

    def serve(**options) -> SimpleNamespace:
        server = Server(tmp_path, Silent, **options)
        servers.append(server)
        _, port, token = re.fullmatch(r"http://([^:]+):(\d+)/(.*)", server.url).groups()
        return SimpleNamespace(server=server, port=int(port), token=token.rstrip("/"))

    yield serve
    for server in servers:
        server.close()


def get(port: int, path: str, host: str = "127.0.0.1", **headers: str) -> SimpleNamespace:
    connection = http.client.HTTPConnection(host, port, timeout=60)
    try:
        connection.request("GET", path, headers=headers)
        response = connection.getresponse()
        return SimpleNamespace(
            status=response.status, headers=response.headers, text=response.read().decode()
        )
    finally:
        connection.close()


def test_without_the_option_only_loopback_is_bound_and_no_token_needed(serve):
    page = serve()
    assert page.token == ""
    assert get(page.port, "/").status == 200
    if sys.platform == "linux":  # all of 127.0.0.0/8 is this computer there
        with pytest.raises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.2", page.port), timeout=60)


@pytest.mark.skipif(sys.platform != "linux", reason="127.0.0.2 is an address on Linux only")
def test_with_it_every_address_answers_to_the_token(serve):
    page = serve(lan=True)
    assert re.fullmatch(r"[a-z2-9]{16}", page.token)
    for host in ("127.0.0.1", "127.0.0.2"):
        assert get(page.port, f"/{page.token}/", host).text == "<p>hello</p>"
        assert get(page.port, f"/{page.token}/part.js", host).status == 200
        with connect(
            f"ws://{host}:{page.port}/{page.token}/live", origin=f"http://{host}:{page.port}"
        ) as browser:
            assert browser.recv(timeout=60) == "hello"


@pytest.mark.parametrize(
    "path",
    [
        "/",
        "/index.html",
        "/part.js",
        "/live",
        "/nothing",
        "/aaaaaaaaaaaaaaaa/",
        "//{token}/",
        "/{token}x/",
        "/?{token}",
        "/%C3%A4/",
        "/{other}/",
    ],
)
def test_every_route_demands_the_token(serve, path):
    page, other = serve(lan=True), serve(lan=True)
    answer = get(page.port, path.format(token=page.token, other=other.token))
    assert answer.status == 403
    assert "token" in answer.text
    assert page.token not in answer.text


def test_the_live_stream_demands_the_token_and_an_own_origin(serve):
    page = serve(lan=True)
    for path, origin in ((f"{page.token[:-1]}!/live", None), (f"{page.token}/live", "http://evil")):
        with (
            pytest.raises(InvalidStatus) as refused,
            connect(f"ws://127.0.0.1:{page.port}/{path}", origin=origin),
        ):
            pass
        assert refused.value.response.status_code == 403


def test_the_address_without_its_last_slash_leads_to_the_page(serve):
    page = serve(lan=True)
    answer = get(page.port, f"/{page.token}")
    assert (answer.status, answer.headers["Location"]) == (308, f"{page.token}/")


@pytest.mark.parametrize("host", ["hub.example", "127.0.0.1"])
def test_behind_a_proxy_any_host_needs_the_token(serve, host):
    page = serve(proxied=True)
    for path in ("/", "/live", "/part.js", "/kit/kit.css", f"/{page.token[:-1]}1/", "/nothing"):
        answer = get(page.port, path, Host=host)
        assert answer.status == 403
        assert "token" in answer.text
    index = get(page.port, f"/{page.token}/", Host=host)
    assert index.text == "<p>hello</p>"
    assert f"ws://{host}" in index.headers["Content-Security-Policy"]
    assert "frame-ancestors 'none'" in index.headers["Content-Security-Policy"]


@pytest.mark.skipif(sys.platform != "linux", reason="127.0.0.2 is an address on Linux only")
def test_behind_a_proxy_only_loopback_is_bound(serve):
    page = serve(proxied=True)
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", page.port), timeout=60)


def test_behind_a_proxy_only_own_pages_open_the_websocket(serve):
    page = serve(proxied=True)
    address = f"ws://127.0.0.1:{page.port}/{page.token}/live"
    forwarded = {"X-Forwarded-Host": "hub.example"}
    with connect(address, origin="https://hub.example", additional_headers=forwarded) as browser:
        assert browser.recv(timeout=60) == "hello"
    for headers in ({}, {"X-Forwarded-Host": "other.example"}):
        with (
            pytest.raises(InvalidStatus) as refused,
            connect(address, origin="https://hub.example", additional_headers=headers),
        ):
            pass
        assert refused.value.response.status_code == 403


def test_two_runs_have_two_tokens():
    assert lan.new_token() != lan.new_token()


def test_a_path_outside_of_ascii_is_no_token():
    assert lan.path_below("abc", "/ab\udcff/") is None
    assert lan.path_below("abc", "/äbc/") is None
    assert lan.path_below("abc", "/abc/x/y") == "/x/y"
    assert lan.path_below("abc", "/abc") == ""


@pytest.mark.parametrize(
    "host", ["192.168.1.7:7070", "10.0.0.1", "localhost:1", "robot", "robot.local:80"]
)
def test_hosts_of_this_computer_are_welcome_in_the_network(monkeypatch, host):
    monkeypatch.setattr(socket, "gethostname", lambda: "Robot.example.org")
    assert refusal([host], [f"http://{host}"], lan=True) is None
    assert (refusal([host], []) is None) == host.startswith("localhost")


@pytest.mark.parametrize(
    "host", ["evil.example", "192.168.1", "192.168.1.7.evil.example", "0x7f.1", ""]
)
def test_other_hosts_are_not(monkeypatch, host):
    monkeypatch.setattr(socket, "gethostname", lambda: "robot")
    assert "Host is" in refusal([host], [], lan=True)


# What the terminal shows


class Terminal(io.StringIO):
    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


@pytest.fixture
def terminal(monkeypatch):
    pytest.importorskip("segno")
    monkeypatch.setattr(shutil, "get_terminal_size", lambda **_: os.terminal_size((80, 24)))
    return Terminal()


def invite(monkeypatch, terminal: Terminal, *addresses: str) -> list[str]:
    monkeypatch.setattr(sys, "stdout", terminal)  # here: pytest sets its own before each phase
    monkeypatch.setattr(lan, "lan_addresses", lambda: list(addresses))
    lines: list[str] = []
    lan.invite("http://127.0.0.1:7070/abc/", lines.append)
    return lines


def dark_modules(text: str) -> list[list[int]]:
    """The modules that half blocks in black on white show."""
    rows = []
    for line in re.findall(r"\x1b\[38;5;16;48;5;231m(.*)\x1b\[0m", text):
        rows.append([int(letter in "▀█") for letter in line])
        rows.append([int(letter in "▄█") for letter in line])
    return rows


def test_the_code_in_the_terminal_is_that_of_the_address(monkeypatch, terminal):
    lines = invite(monkeypatch, terminal, "192.168.1.7")
    assert lines[0] == "On another device of this network: http://192.168.1.7:7070/abc/"
    assert "not encrypted" in lines[1]
    assert len(lines) == 2
    shown = dark_modules(terminal.getvalue())
    matrix = (
        sys.modules["segno"].make("http://192.168.1.7:7070/abc/", error="l", micro=False).matrix
    )
    assert [row[2:-2] for row in shown[2 : 2 + len(matrix)]] == [list(row) for row in matrix]
    border = [*shown[:2], *shown[2 + len(matrix) :], *(row[:2] + row[-2:] for row in shown)]
    assert not any(any(row) for row in border)
    assert len(shown) // 2 <= 20
    assert len(shown[0]) < 40


def test_other_addresses_are_named_too(monkeypatch, terminal):
    lines = invite(monkeypatch, terminal, "192.168.1.7", "172.17.0.1", "10.8.0.2")
    assert "172.17.0.1 or 10.8.0.2" in lines[2]


def test_without_a_network_the_line_says_so(monkeypatch, terminal):
    (line,) = invite(monkeypatch, terminal)
    assert "no network address but loopback" in line
    assert terminal.getvalue() == ""


@pytest.mark.parametrize(
    ("obstacle", "said"),
    [("library", "pip install segno"), ("width", "wider terminal"), ("encoding", "UTF-8")],
)
def test_address_and_a_line_remain_without_a_qr_code(monkeypatch, terminal, obstacle, said):
    if obstacle == "library":
        monkeypatch.setitem(sys.modules, "segno", None)
    elif obstacle == "width":
        monkeypatch.setattr(shutil, "get_terminal_size", lambda **_: os.terminal_size((20, 24)))
    else:
        monkeypatch.setattr(Terminal, "encoding", "ascii")
    lines = invite(monkeypatch, terminal, "192.168.1.7")
    assert "http://192.168.1.7:7070/abc/" in lines[0]
    assert said in lines[-1]
    assert terminal.getvalue() == ""


def test_a_file_gets_no_code(monkeypatch, terminal):
    monkeypatch.setattr(Terminal, "isatty", lambda self: False)
    assert len(invite(monkeypatch, terminal, "192.168.1.7")) == 2
    assert terminal.getvalue() == ""


def test_the_addresses_are_those_of_this_computer():
    found = lan.lan_addresses()
    assert not any(address.startswith("127.") for address in found)
    assert set(found) <= set(lan.interface_addresses())


# What a page may be made of, besides files


def test_computed_answers(serve):
    asked = []

    def answer(path: str) -> WebContent | None:
        asked.append(path)
        if path == "/defect":
            raise RuntimeError("a defect")
        return WebContent(b"solid", "model/stl") if path == "/mesh/a b.stl" else None

    page = serve(answer=answer, lan=True)
    mesh = get(page.port, f"/{page.token}/mesh/a%20b.stl?v=2")
    assert (mesh.status, mesh.text, mesh.headers["Content-Type"]) == (200, "solid", "model/stl")
    assert mesh.headers["X-Content-Type-Options"] == "nosniff"
    assert get(page.port, f"/{page.token}/other").status == 404
    assert get(page.port, f"/{page.token}/").text == "<p>hello</p>"
    assert get(page.port, "/mesh/a%20b.stl").status == 403
    assert asked == ["/mesh/a b.stl", "/other"]


def test_a_defect_of_a_computed_answer_is_reported(serve, caplog):
    def answer(path: str) -> WebContent | None:
        raise RuntimeError("a defect of the page")

    page = serve(answer=answer)
    assert get(page.port, "/x").status == 500
    assert get(page.port, "/").status == 200
    assert "a defect of the page" in caplog.text


def test_vendored_files_are_kept_and_sources_added(serve, tmp_path):
    (tmp_path / "lib-1.2").mkdir()
    (tmp_path / "lib-1.2" / "lib.js").write_text("export const answer = 42;")
    page = serve(immutable="/lib-1.2/", sources={"connect-src": "blob:", "worker-src": "'self'"})
    assert "immutable" in get(page.port, "/lib-1.2/lib.js").headers["Cache-Control"]
    index = get(page.port, "/")
    assert index.headers["Cache-Control"] == "no-cache"
    policy = index.headers["Content-Security-Policy"].split("; ")
    assert f"connect-src 'self' ws://127.0.0.1:{page.port} blob:" in policy
    assert "worker-src 'self'" in policy


def test_page_import_map_works_and_other_inline_scripts_do_not(serve, tmp_path, browser):
    (tmp_path / "lib-1.2").mkdir()
    (tmp_path / "lib-1.2" / "lib.js").write_text("export const answer = 42;")
    (tmp_path / "main.js").write_text(
        "import { answer } from 'lib';\n"
        "const live = new URL('live', location.href);\n"
        "live.protocol = 'ws:';\n"
        "new WebSocket(live).onmessage = ({ data }) => {\n"
        "  document.title = `${answer} ${data} ${window.bad ?? 'good'}`;\n"
        "};\n"
    )
    (tmp_path / "index.html").write_text(
        '<script type="importmap">\n{ "imports": { "lib": "./lib-1.2/lib.js" } }\n</script>'
        "<script>window.bad = 'bad';</script>"
        '<script type="module" src="main.js"></script>'
    )
    page = serve(lan=True, immutable="/lib-1.2/")
    context = browser.new_context()
    try:
        shown = context.new_page()
        shown.goto(page.server.url)
        shown.wait_for_function("() => document.title === '42 hello good'", timeout=120_000)
    finally:
        context.close()
