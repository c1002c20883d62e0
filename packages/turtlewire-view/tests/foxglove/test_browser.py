"""A real browser: pages of Foxglove and of this machine connect, and others do not."""

import json

import pytest

PAGE = """
<!doctype html><title>page</title><script>
  const socket = new WebSocket(%s, %s);
  socket.onmessage = (event) => { document.title = JSON.parse(event.data).op; };
  socket.onerror = () => { document.title = "refused"; };
</script>
"""


@pytest.mark.parametrize(
    ("url", "protocols", "title", "warnings"),
    [
        ("http://localhost:8080/", ["foxglove.sdk.v1", "foxglove.websocket.v1"], "serverInfo", 0),
        ("http://127.0.0.1:8080/", ["foxglove.websocket.v1"], "serverInfo", 0),
        ("https://app.foxglove.dev/", ["foxglove.sdk.v1"], "serverInfo", 0),
        ("https://evil.example/", ["foxglove.sdk.v1"], "refused", 1),
        ("http://localhost:8080/", ["other"], "refused", 0),
    ],
)
def test_pages_of_a_browser(serve, log, browser, url, protocols, title, warnings):
    server = serve()
    # What the user grants when the browser asks whether a page may reach programs of this machine.
    context = browser.new_context(permissions=["local-network-access"])
    try:
        page = context.new_page()
        body = PAGE % (json.dumps(server.url), json.dumps(protocols))
        page.route("**/*", lambda route: route.fulfill(body=body, content_type="text/html"))
        page.goto(url)
        page.wait_for_function("() => document.title != 'page'", timeout=120_000)
        assert page.title() == title
        assert len(log.warnings()) == warnings
    finally:
        context.close()
