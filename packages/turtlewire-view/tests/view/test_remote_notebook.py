"""The view of a kernel on another computer: behind an https proxy of a third origin."""

import contextlib
import sys
import types
from types import SimpleNamespace
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

import pytest
from IPython.core.formatters import DisplayFormatter
from tests.plain_server import path_proxy, self_signed

import turtlewire

from .test_notebook import LIMIT_MS, shows_frames

HUB, COLAB_PORT = "hub.example", "7070-x.prod.colab.dev"
COLAB = "https://colab.research.google.com/drive/1"
COLAB_OUTPUT = "https://x-0-colab.googleusercontent.com/outputframe.html"
FOREIGN = "https://evil.example/"
#: How notebooks isolate the outputs of cells.
SANDBOX = 'sandbox="allow-scripts allow-same-origin allow-popups"'
FLAGS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-certificate-errors",
    f"--host-resolver-rules=MAP {HUB} 127.0.0.1, MAP {COLAB_PORT} 127.0.0.1",
)


@pytest.fixture(scope="module")
def remote_browser(chromium):
    """A browser that finds the proxies of both services on this computer."""
    with contextlib.closing(chromium(FLAGS)) as browser:
        yield browser


@pytest.fixture(scope="module")
def tls(tmp_path_factory):
    return self_signed(tmp_path_factory.mktemp("tls"))


@pytest.fixture
def tab(remote_browser):
    with contextlib.closing(remote_browser.new_context()) as context:
        context.set_default_timeout(LIMIT_MS)
        # Chromium asks the user before a page of another computer reaches this one.
        context.grant_permissions(["local-network-access"])
        yield context.new_page()


@pytest.fixture
def show(monkeypatch):
    """Show a buffer in what seems to be a kernel."""
    monkeypatch.delenv("JUPYTERHUB_SERVICE_PREFIX", raising=False)
    kernel = SimpleNamespace(kernel=object())
    monkeypatch.setattr(sys.modules["IPython"], "get_ipython", lambda: kernel)
    with contextlib.ExitStack() as stack:

        def show(**options):
            buffer = turtlewire.Buffer()
            buffer.set_static_transform("world", "camera", (0, 0, 1))
            return stack.enter_context(turtlewire.show(buffer, port=0, **options))

        yield show


@pytest.fixture
def hub(show, monkeypatch, tls):
    """A view in JupyterHub: the address of the hub, of the port below it, and the view."""
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/me/")
    view = show()
    path = f"/user/me/proxy/{urlsplit(view.url).port}/"
    with path_proxy(urlsplit(view.url).port, path, tls) as port:
        home = f"https://{HUB}:{port}"
        yield SimpleNamespace(home=home, below=f"{home}{path}", view=view)


@pytest.fixture
def colab(show, monkeypatch):
    """A view in Colab, and the calls of Colab's function, as its documentation describes it."""
    calls = []

    def serve_kernel_port_as_iframe(
        port, path="/", width="100%", height="400", cache_in_notebook=False
    ):
        calls.append((port, path, width, height, cache_in_notebook))

    output = types.ModuleType("google.colab.output")
    output.serve_kernel_port_as_iframe = serve_kernel_port_as_iframe
    monkeypatch.setitem(sys.modules, "google.colab", types.ModuleType("google.colab"))
    monkeypatch.setitem(sys.modules, "google.colab.output", output)
    return SimpleNamespace(view=show(), calls=calls)


def answer(tab, address, content):
    body = f"<!doctype html><title>Page</title><h1>Page</h1>{content}"
    tab.route(address, lambda route: route.fulfill(body=body, content_type="text/html"))


def isolated(html):
    return f"<iframe {SANDBOX} width=900 height=700 srcdoc='{html}'></iframe>"


def assert_blocked(tab, address):
    """Assert that the browser refuses to show the view in a frame of a page."""
    with tab.expect_console_message(lambda message: "frame-ancestors" in message.text):
        tab.goto(address)


# JupyterHub and Binder


@pytest.mark.slow
def test_a_hub_shows_the_view_in_an_isolated_output(hub, tab):
    answer(tab, f"{hub.home}/lab", isolated(hub.view._repr_html_()))
    tab.goto(f"{hub.home}/lab")
    shows_frames(tab.frame_locator("iframe").frame_locator("iframe"))


@pytest.mark.slow
def test_the_link_opens_the_view_in_a_tab(hub, tab):
    answer(tab, f"{hub.home}/lab", hub.view._repr_html_())
    tab.goto(f"{hub.home}/lab")
    with tab.expect_popup() as opened:
        tab.get_by_text("Open the view in a tab").click()
    shows_frames(opened.value)


@pytest.mark.parametrize("path", ["", "live", "kit/kit.css", "aaaaaaaaaaaaaaaa/"])
def test_a_request_without_the_token_gets_403(hub, tab, path):
    assert tab.goto(hub.below + path).status == 403
    with pytest.raises(HTTPError) as refused:  # on the hub's computer as well
        urlopen(Request(f"http://127.0.0.1:{urlsplit(hub.view.url).port}/{path}"))
    assert refused.value.code == 403
    refused.value.close()


OPEN = """address => new Promise((resolve, reject) => {
  const socket = new WebSocket(address);
  socket.onopen = () => reject(new Error("open"));
  socket.onclose = () => resolve("refused");
})"""


@pytest.mark.parametrize("has_token", [False, True])
def test_a_foreign_page_cannot_connect(hub, tab, has_token):
    answer(tab, FOREIGN, "")
    tab.goto(FOREIGN)
    address = hub.below.replace("https", "wss", 1)
    token = urlsplit(hub.view.url).path[1:] if has_token else ""
    with tab.expect_console_message(lambda message: "response code: 403" in message.text):
        assert tab.evaluate(OPEN, f"{address}{token}live") == "refused"


def test_a_foreign_page_with_the_token_cannot_embed_the_view(hub, tab):
    html = hub.view._repr_html_().replace('src="', f'src="{hub.home}')
    answer(tab, FOREIGN, html)
    assert_blocked(tab, FOREIGN)


def test_the_output_of_a_hub_has_the_token_only_in_addresses(hub):
    path = urlsplit(hub.view.url)
    html = hub.view._repr_html_()
    assert html.count(f'="/user/me/proxy/{path.port}{path.path}"') == 2
    assert html.count(path.path) == 2
    assert "jupyter-server-proxy" in html


# An address that the user names


@pytest.mark.parametrize(
    ("proxy", "address"),
    [
        ("/proxy/{port}/", "/proxy/{port}/"),
        ("/proxy/{port}", "/proxy/{port}/"),
        ("https://me-{port}.example/", "https://me-{port}.example/"),
    ],
)
def test_a_proxy_is_a_path_or_an_address(show, monkeypatch, proxy, address):
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/me/")  # the argument comes first
    view = show(proxy=proxy)
    port, path = urlsplit(view.url).port, urlsplit(view.url).path
    assert f'src="{address.format(port=port)}{path[1:]}"' in view._repr_html_()


def test_a_notebook_below_a_base_url_shows_the_view(show, tab):
    """A Jupyter that a tunnel brings to this computer has an address with http."""
    view = show(proxy="/lab7/proxy/{port}/")
    port = urlsplit(view.url).port
    with path_proxy(port, f"/lab7/proxy/{port}/") as proxy:
        home = f"http://localhost:{proxy}/lab7/lab"
        answer(tab, home, isolated(view._repr_html_()))
        tab.goto(home)
        shows_frames(tab.frame_locator("iframe").frame_locator("iframe"))


@pytest.mark.parametrize("proxy", ["/proxy/7070/", "proxy/{port}/", "javascript:{port}", ""])
def test_a_proxy_without_a_port_or_a_start_is_explained(show, proxy):
    with pytest.raises(ValueError, match=r"such as '/proxy/\{port\}/'"):
        show(proxy=proxy)


def test_a_view_behind_a_proxy_does_not_open_to_the_network(show):
    with pytest.raises(ValueError, match="leave out lan"):
        show(proxy="/proxy/{port}/", lan=True)


def test_a_proxy_of_another_type_is_rejected(show):
    with pytest.raises(TypeError, match="proxy must be str, not bool"):
        show(proxy=True)


# Colab


def test_colab_shows_the_port_and_path_of_the_view(colab):
    """IPython formats nothing else for a cell after the view has displayed itself."""
    assert DisplayFormatter().format(colab.view) == ({}, {})
    address = urlsplit(colab.view.url)
    assert colab.calls == [(address.port, address.path, "100%", "540", False)]


def test_other_notebooks_show_the_html(hub, show):
    html = DisplayFormatter().format(hub.view)[0]["text/html"]
    assert html == hub.view._repr_html_()


@pytest.mark.slow
@pytest.mark.parametrize("top", [COLAB, FOREIGN])
def test_colab_and_no_foreign_page_embeds_the_view(colab, tab, tls, top):
    """Colab's function makes a frame with an address at another host."""
    port, path = urlsplit(colab.view.url).port, urlsplit(colab.view.url).path
    with path_proxy(port, "/", tls) as proxy:
        view = f"https://{COLAB_PORT}:{proxy}{path}"
        answer(tab, COLAB_OUTPUT, f'<iframe src="{view}" width="100%" height="540"></iframe>')
        answer(tab, top, f'<iframe {SANDBOX} width=900 height=700 src="{COLAB_OUTPUT}"></iframe>')
        if top == FOREIGN:
            assert_blocked(tab, top)
            return
        tab.goto(top)
        shows_frames(tab.frame_locator("iframe").frame_locator("iframe"))


# The notebook of this computer


def test_a_local_notebook_needs_no_token(show):
    view = show()
    assert urlsplit(view.url).path == "/"
