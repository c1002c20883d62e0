"""Files as the server sends them: compressed, and not at all to a browser that has them."""

import gzip
import http.client
import os
from urllib.parse import urlsplit

import pytest

from turtlewire.web import Server, WebContent
from turtlewire.web.files import takes_gzip

SCRIPT = "export const answer = 42;\n" * 100


class Silent:
    """A session that has nothing to say."""

    def outgoing(self):
        return []

    def receive(self, message):
        pass

    def closed(self):
        pass


@pytest.fixture
def root(tmp_path):
    (tmp_path / "index.html").write_text("<p>small</p>")
    (tmp_path / "main.js").write_text(SCRIPT)
    (tmp_path / "style.css").write_text("p { color: red; }\n" * 100)
    (tmp_path / "words.json").write_text("[" + "1, " * 1000 + "1]")
    (tmp_path / "photo.png").write_bytes(b"\x89PNG" + bytes(5000))
    return tmp_path


@pytest.fixture
def start():
    servers = []

    def start(root, **options):
        servers.append(Server(root, Silent, **options))
        return servers[-1]

    yield start
    for server in servers:
        server.close()


@pytest.fixture
def server(root, start):
    return start(root)


def get(server, path, *accepted, **headers):
    """Status, headers and the bytes as they came."""
    address = urlsplit(server.url)
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=60)
    try:
        connection.putrequest("GET", address.path.rstrip("/") + path, skip_accept_encoding=True)
        for field in accepted:
            connection.putheader("Accept-Encoding", field)
        for name, value in headers.items():
            connection.putheader(name.replace("_", "-"), value)
        connection.endheaders()
        response = connection.getresponse()
        response.body = response.read()
        return response
    finally:
        connection.close()


@pytest.mark.parametrize("name", ["main.js", "style.css", "words.json"])
def test_texts_are_compressed(server, root, name):
    response = get(server, f"/{name}", "gzip, deflate, br")
    assert response.headers["Content-Encoding"] == "gzip"
    assert int(response.headers["Content-Length"]) == len(response.body)
    assert len(response.body) < (root / name).stat().st_size / 5
    assert gzip.decompress(response.body) == (root / name).read_bytes()


@pytest.mark.parametrize("fields", [[], ["identity"], ["gzip;q=0"], ["br, gzip; q=0.0", "deflate"]])
def test_a_browser_that_does_not_take_gzip_gets_the_file(server, fields):
    response = get(server, "/main.js", *fields)
    assert "Content-Encoding" not in response.headers
    assert response.headers["Vary"] == "Accept-Encoding"
    assert response.body == SCRIPT.encode()


@pytest.mark.parametrize("name", ["", "photo.png"])
def test_small_files_and_pictures_are_sent_as_they_are(server, root, name):
    response = get(server, f"/{name}", "gzip")
    assert "Content-Encoding" not in response.headers
    assert "Vary" not in response.headers
    assert response.body == (root / (name or "index.html")).read_bytes()


@pytest.mark.parametrize(("size", "is_compressed"), [(1023, False), (1024, True)])
def test_from_which_size_a_text_is_compressed(root, start, size, is_compressed):
    (root / "x.js").write_text("x" * size)
    response = get(start(root), "/x.js", "gzip")
    assert ("Content-Encoding" in response.headers) is is_compressed


def test_a_file_is_compressed_once_and_again_when_it_changes(server, root, monkeypatch):
    compressed = []
    compress = gzip.compress

    def count(body, **options):
        compressed.append(body)
        return compress(body, **options)

    monkeypatch.setattr(gzip, "compress", count)
    first, second = (get(server, "/main.js", "gzip") for _ in range(2))
    assert first.body == second.body
    assert first.headers["ETag"] == second.headers["ETag"]
    assert compressed == [SCRIPT.encode()]
    (root / "main.js").write_text("export {};\n" * 300)
    os.utime(root / "main.js", (1, 1))
    changed = get(server, "/main.js", "gzip")
    assert gzip.decompress(changed.body) == b"export {};\n" * 300
    assert changed.headers["ETag"] != first.headers["ETag"]
    assert len(compressed) == 2


def test_cached_files_are_not_sent_again(server):
    plain, packed = get(server, "/main.js"), get(server, "/main.js", "gzip")
    tags = [response.headers["ETag"] for response in (plain, packed)]
    assert tags[0] != tags[1]  # the bytes are other ones
    for accepted, tag in (([], tags[0]), (["gzip"], tags[1])):
        for field in (tag, f'"other", W/{tag}', "*"):
            again = get(server, "/main.js", *accepted, If_None_Match=field)
            assert (again.status, again.body) == (304, b"")
            assert again.headers["ETag"] == tag
            assert again.headers["Vary"] == "Accept-Encoding"
            assert again.headers["Cache-Control"] == "no-cache"
            assert "Content-Encoding" not in again.headers
    assert get(server, "/main.js", If_None_Match=tags[1]).status == 200
    assert get(server, "/main.js", "gzip", If_None_Match='"other"').status == 200


def test_computed_answers_are_never_compressed(root, start):
    """Such an answer may contain a secret, which its length would reveal."""
    body = b"x" * 5000
    server = start(root, answer=lambda path: WebContent(body, "text/plain"))
    response = get(server, "/computed", "gzip")
    assert "Content-Encoding" not in response.headers
    assert response.body == body


def test_no_file_of_a_page_for_the_network_holds_the_token(root, start):
    server = start(root, lan=True)
    token = urlsplit(server.url).path.strip("/")
    for name in ("main.js", "style.css", "words.json", ""):
        for accepted in ([], ["gzip"]):
            response = get(server, f"/{name}", *accepted)
            assert response.status == 200
            body = response.body
            text = gzip.decompress(body) if "Content-Encoding" in response.headers else body
            assert token.encode() not in text
            assert token not in str(response.headers)


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        (["gzip"], True),
        (["GZIP"], True),
        (["x-gzip"], True),
        (["*"], True),
        (["*;q=0"], False),
        (["br;q=1.0, gzip;q=0.5"], True),
        (["br", "gzip"], True),
        (["gzip;q=0.001"], True),
        (["gzip;q=0, *"], False),
        (["gzip;q=nonsense"], False),
        (["gzipped"], False),
        ([""], False),
        ([], False),
    ],
)
def test_which_headers_allow_gzip(fields, expected):
    assert takes_gzip(fields) is expected
