"""The server over real sockets.

Files, refusals, latest-wins streams, and that closing always returns.
"""

from __future__ import annotations

import contextlib
import http.client
import json
import socket
import subprocess
import sys
import threading
import types

import pytest
from tests.programs import run_python
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from turtlewire.web import Server


class Counter:
    """A session that sends the newest value of a shared counter, and answers messages."""

    def __init__(self, shared: dict) -> None:
        self._shared = shared
        self._answers: list[str | bytes] = []
        shared["sessions"].append(self)
        self.is_closed = threading.Event()

    def outgoing(self) -> list[str | bytes]:
        answers, self._answers = self._answers, []
        return [*answers, json.dumps(self._shared["value"])]

    def receive(self, message: str | bytes) -> None:
        if message == "fail":
            raise RuntimeError("a defect of the session")
        self._answers.append(message)

    def closed(self) -> None:
        self.is_closed.set()


@pytest.fixture
def page(tmp_path):
    (tmp_path / "index.html").write_text("<p>hello</p>")
    (tmp_path / "js").mkdir()
    (tmp_path / "js" / "main.js").write_text("export {};")
    (tmp_path / "secret.txt").write_text("no")
    return tmp_path


@pytest.fixture
def shared():
    return {"value": 0, "sessions": []}


@pytest.fixture
def server(page, shared):
    server = Server(page, lambda: Counter(shared))
    yield server
    server.close()


def get(server: Server, path: str, method: str = "GET", **headers: str) -> http.client.HTTPResponse:
    host, port = server.url.removeprefix("http://").rstrip("/").split(":")
    connection = http.client.HTTPConnection(host, int(port), timeout=60)
    try:
        connection.putrequest(method, path, skip_host="Host" in headers)
        for name, value in headers.items():
            connection.putheader(name, value)
        connection.endheaders()
        response = connection.getresponse()
        response.text = response.read().decode()
        return response
    finally:
        connection.close()


def get_with_hosts(server: Server, *hosts: str) -> int:
    """The status of a request with these ``Host`` headers."""
    host, port = server.url.removeprefix("http://").rstrip("/").split(":")
    connection = http.client.HTTPConnection(host, int(port), timeout=60)
    with contextlib.closing(connection):
        connection.putrequest("GET", "/", skip_host=True)
        for name in hosts:
            connection.putheader("Host", name)
        connection.endheaders()
        return connection.getresponse().status


def live(server: Server, **options) -> connect:
    """Connect without keepalive: on a busy machine an answer may take longer than its 20 s."""
    return connect(server.url.replace("http", "ws") + "live", ping_interval=None, **options)


def read_to_end(browser) -> ConnectionClosed:
    """Read until the server closes the WebSocket."""
    while True:
        try:
            browser.recv(timeout=60)
        except ConnectionClosed as closed:
            return closed


def test_files_are_served_with_their_type_and_strict_headers(server):
    index = get(server, "/?anything")
    assert (index.status, index.text) == (200, "<p>hello</p>")
    assert index.headers["Content-Type"] == "text/html; charset=utf-8"
    assert "default-src 'none'" in index.headers["Content-Security-Policy"]
    assert index.headers["X-Content-Type-Options"] == "nosniff"
    script = get(server, "/js/main.js")
    assert (script.status, script.headers["Content-Type"]) == (
        200,
        "text/javascript; charset=utf-8",
    )


def test_every_page_has_the_kit(server):
    style = get(server, "/kit/kit.css")
    assert (style.status, style.headers["Content-Type"]) == (200, "text/css; charset=utf-8")
    assert "--paper" in style.text
    assert get(server, "/kit/connection.js").status == 200
    assert get(server, "/kit/").status == 404


@pytest.mark.parametrize(
    "path",
    [
        "/secret.txt",
        "/kit/../server.py",
        "/kit/nothing.js",
        "/../pyproject.toml",
        "/js/../../x.html",
        "/js",
        "/%2e%2e/index.html",
        "//index.html",
    ],
)
def test_nothing_else_is_served(server, path):
    assert get(server, path).status == 404


def test_foreign_names_and_pages_are_refused(server):
    assert get(server, "/", Host="evil.example:80").status == 403
    assert get_with_hosts(server, "localhost", "evil.example") == 403
    assert get_with_hosts(server, "localhost", "localhost") == 403
    assert get_with_hosts(server, "localhost") == 200
    assert get(server, "/", Origin="http://evil.example").status == 403
    with pytest.raises(InvalidStatus) as refused, live(server, origin="http://evil.example"):
        pass
    assert refused.value.response.status_code == 403
    assert b"evil.example" in refused.value.response.body
    with live(server, origin=server.url.rstrip("/")) as own:
        assert own.recv(timeout=60) == "0"


def test_only_get(server):
    try:
        status = get(server, "/", method="POST").status
    except http.client.RemoteDisconnected:
        status = None  # websockets before 17, the last for Python 3.10, closes the connection
    assert status in (None, 400, 405)
    assert get(server, "/").status == 200


def test_non_http_requests_leave_the_server_alive(server):
    port = int(server.url.split(":")[2].rstrip("/"))
    for junk in (
        b"\x00\xff\x16\x03\x01 nonsense\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost\r\n\r\n",
        b"G" * 20000,
    ):
        with socket.create_connection(("127.0.0.1", port), timeout=60) as raw:
            raw.sendall(junk)
            raw.settimeout(60)
            with contextlib.suppress(ConnectionResetError):
                assert b"200 OK" not in raw.recv(4096)
    assert get(server, "/").status == 200


def test_every_browser_gets_the_newest_value(server, shared):
    with live(server) as one, live(server) as two:
        assert one.recv(timeout=60) == two.recv(timeout=60) == "0"
        shared["value"] = 7
        server.notify()
        assert one.recv(timeout=60) == two.recv(timeout=60) == "7"
        assert server.watched


def test_a_slow_browser_gets_fewer_messages_and_the_newest_at_the_end(server, shared):
    """The browser stops reading while far more is offered than any buffer holds."""
    shared["value"] = "x" * 50_000
    with live(server, max_queue=2, max_size=None) as slow:
        slow.recv(timeout=60)
        offered = 1000
        for number in range(offered):
            shared["value"] = f"{number} " + "x" * 50_000
            server.notify()
            get(server, "/")  # one round trip: the server's thread had its turn
        received = [int(json.loads(slow.recv(timeout=60)).split()[0])]
        while received[-1] != offered - 1:
            received.append(int(json.loads(slow.recv(timeout=60)).split()[0]))
    assert received == sorted(set(received))
    assert len(received) < offered / 2


def test_messages_are_answered_and_long_ones_end_only_their_sender(server):
    with live(server) as browser, live(server) as bystander:
        browser.recv(timeout=60)
        browser.send("echo")
        assert browser.recv(timeout=60) == "echo"
        browser.send("x" * 100_000)
        assert read_to_end(browser).rcvd.code == 1009
        bystander.send("still here")
        bystander.recv(timeout=60)
        assert bystander.recv(timeout=60) == "still here"


def test_a_session_learns_that_its_browser_left(server, shared):
    with live(server) as browser:
        browser.recv(timeout=60)
    assert shared["sessions"][0].is_closed.wait(60)
    assert get(server, "/").status == 200


def test_a_defect_of_a_session_is_reported_and_ends_only_its_browser(server, caplog):
    with live(server) as browser, live(server) as bystander:
        browser.send("fail")
        assert read_to_end(browser).rcvd.code == 1011
        bystander.recv(timeout=60)
        bystander.send("still here")
        assert bystander.recv(timeout=60) == "still here"
    assert "a defect of the session" in caplog.text


def test_a_taken_port_is_replaced_by_a_free_one(page, shared, server):
    taken = int(server.url.split(":")[2].rstrip("/"))
    other = Server(page, lambda: Counter(shared), port=taken)
    try:
        assert other.url != server.url
        assert get(other, "/").status == 200
    finally:
        other.close()


def test_closing_returns_whatever_the_clients_do(page, shared):
    server = Server(page, lambda: Counter(shared))
    port = int(server.url.split(":")[2].rstrip("/"))
    with (
        live(server) as reader,
        live(server) as deaf,
        socket.create_connection(("127.0.0.1", port)),
        socket.create_connection(("127.0.0.1", port)) as half,
    ):
        half.sendall(b"GET / HT")
        deaf.socket.settimeout(None)
        reader.recv(timeout=60)
        server.close()
        assert read_to_end(reader).rcvd.code == 1001
    server.close()
    server.notify()
    with pytest.raises(OSError):
        socket.create_connection(("127.0.0.1", port), timeout=1).close()


def test_closing_at_once_returns(page, shared):
    for _ in range(3):
        Server(page, lambda: Counter(shared)).close()


#: A server that may open only a few more files, until its standard input ends.
FEW_FILES = """
import os, pathlib, resource, sys
from turtlewire.web import Server
class PageSession:
    def outgoing(self): return []
    def receive(self, message): pass
    def closed(self): pass
server = Server(pathlib.Path(sys.argv[1]), PageSession)
import http, websockets.http11
limit = max(map(int, os.listdir("/proc/self/fd"))) + 8
resource.setrlimit(resource.RLIMIT_NOFILE, (limit, limit))
print(server.url, flush=True)
sys.stdin.read()
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="counts the files in /proc")
def test_running_out_of_files_is_reported_once_and_passes(page):
    with subprocess.Popen(
        [sys.executable, "-c", FEW_FILES, str(page)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as program:
        url = program.stdout.readline().strip()
        address = ("127.0.0.1", int(url.split(":")[2].rstrip("/")))
        with contextlib.ExitStack() as sockets:
            for _ in range(40):
                sockets.enter_context(socket.create_connection(address, timeout=60))
            said = program.stderr.readline()
        response = get(types.SimpleNamespace(url=url), "/")
        assert (response.status, response.text) == (200, "<p>hello</p>")
        program.stdin.close()
        assert program.stderr.read() == ""
        assert program.wait(60) == 0
    assert "No more browsers can connect: Too many open files." in said


def test_importing_the_room_stays_light():
    code = (
        "import sys, turtlewire.web; print(*[name for name in ('asyncio', 'websockets', 'http') "
        "if name in sys.modules])"
    )
    assert run_python(code).stdout.strip() == ""
