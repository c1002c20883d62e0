"""The view in the output of a notebook's cell: pages of other origins embed it."""

import contextlib
import sys
import types
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

import pytest
from tests.needs import only_first_is_fast
from tests.plain_server import path_proxy, plain_server
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import turtlewire
from turtlewire_view.notebook import Frame

LIMIT_MS = 120_000
FOREIGN = "https://notebook.example/"


@pytest.fixture
def kernel(monkeypatch):
    """Pretend to be an IPython kernel."""
    monkeypatch.delenv("JUPYTERHUB_SERVICE_PREFIX", raising=False)
    module = types.ModuleType("IPython")
    module.get_ipython = lambda: types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", module)


@pytest.fixture
def view(kernel):
    buffer = turtlewire.Buffer()
    buffer.set_static_transform("world", "camera", (0, 0, 1))
    with turtlewire.show(buffer, port=0) as view:
        yield view


@pytest.fixture
def jupyter(tmp_path):
    """Return the port of a server of the pages in ``tmp_path``."""
    with plain_server(tmp_path) as port:
        yield port


@pytest.fixture
def tab(browser_3d):
    with contextlib.closing(browser_3d.new_context()) as context:
        context.set_default_timeout(LIMIT_MS)
        yield context.new_page()


def write_page(path, content):
    path.write_text(f"<!doctype html><title>Notebook</title><h1>Notebook</h1>{content}")


def shows_frames(frame):
    """Wait until the page in a frame has its WebSocket and the frames of the buffer."""
    frame.locator("#connection[data-state=live]").wait_for()
    frame.locator("#tree .row:has-text('camera')").wait_for()


@pytest.mark.parametrize("name", only_first_is_fast("localhost", "127.0.0.1"))
def test_a_notebook_at_another_port_shows_the_view(view, jupyter, tab, tmp_path, name):
    write_page(tmp_path / "notebook.html", view._repr_html_())
    tab.goto(f"http://{name}:{jupyter}/notebook.html")
    shows_frames(tab.frame_locator("iframe"))


def test_outputs_in_a_frame_of_a_third_origin_show_the_view(view, jupyter, tab, tmp_path):
    """Some notebooks isolate the output of a cell in a frame with an origin of its own."""
    write_page(tmp_path / "output.html", view._repr_html_())
    frame = (
        f'<iframe src="http://127.0.0.1:{jupyter}/output.html" width="900" height="700" '
        'sandbox="allow-scripts allow-same-origin"></iframe>'
    )
    write_page(tmp_path / "notebook.html", frame)
    tab.goto(f"http://localhost:{jupyter}/notebook.html")
    shows_frames(tab.frame_locator("iframe").frame_locator("iframe"))


def test_the_view_works_below_a_path_of_the_notebook_server(view, tab):
    """`jupyter-server-proxy` serves it there, so a second port need not be forwarded."""
    port = urlsplit(view.url).port
    with path_proxy(port, f"/user/me/proxy/{port}/") as proxy, contextlib.closing(tab):
        tab.goto(f"http://localhost:{proxy}/user/me/proxy/{port}/")
        shows_frames(tab)


@pytest.mark.parametrize("name", ["hub.example", "192.0.2.7"])
def test_a_notebook_server_under_another_name_is_refused(view, name):
    request = Request(view.url, headers={"Host": name})
    with pytest.raises(HTTPError) as refused:
        urlopen(request)
    assert refused.value.code == 403
    refused.value.close()


def assert_blocked(tab, view):
    """Assert that the browser refuses to show the view in a frame.

    Chromium by itself asks the user before a page of another computer reaches this one.
    """
    tab.context.grant_permissions(["local-network-access"])
    with tab.expect_console_message(lambda message: "frame-ancestors" in message.text):
        tab.goto(FOREIGN)
    assert view.url not in {frame.url for frame in tab.frames}


def answer(tab, content):
    tab.route(FOREIGN, lambda route: route.fulfill(body=content, content_type="text/html"))


def test_a_page_of_another_computer_cannot_embed_the_view(view, tab):
    answer(tab, view._repr_html_())
    assert_blocked(tab, view)


def test_a_page_around_a_notebook_cannot_embed_the_view(view, jupyter, tab, tmp_path):
    write_page(tmp_path / "notebook.html", view._repr_html_())
    answer(tab, f'<iframe src="http://localhost:{jupyter}/notebook.html"></iframe>')
    assert_blocked(tab, view)


@pytest.mark.parametrize("origin", ["http://localhost:8888", "https://notebook.example", "null"])
def test_the_page_around_the_view_cannot_open_its_websocket(view, origin):
    address = f"{view.url.replace('http', 'ws', 1)}live"
    with pytest.raises(InvalidStatus) as refused, connect(address, origin=origin):
        pass
    assert refused.value.response.status_code == 403
    assert b"answers only to its own pages" in refused.value.response.body


def test_only_kernels_allow_other_pages_to_embed_the_view(monkeypatch):
    ipython = types.ModuleType("IPython")
    ipython.get_ipython = lambda: None  # imported, but not running
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    with turtlewire.show(turtlewire.Buffer(), port=0) as view, urlopen(view.url) as answered:
        assert "frame-ancestors 'none'" in answered.headers["Content-Security-Policy"]


def test_the_output_links_the_page_and_says_how_to_forward_its_port():
    html = Frame().html('http://127.0.0.1:7071/"<token>/')
    assert '<a href="http://127.0.0.1:7071/&quot;&lt;token&gt;/"' in html
    assert "ssh -L 7071:localhost:7071" in html
